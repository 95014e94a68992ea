// What every effect of effects.def owes the model, whatever it is: a new line in the list is tested here.
#include <gtest/gtest.h>

#include "ident/core/dual.h"
#include "ident/core/random.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "ident/model/flight.h"
#include "support/run_program.h"

namespace ident {
namespace {

struct Here {
  static constexpr int kBytes = 16;
};
using D = Dual<1, Here>;

/// Eight rotors, so that every numbered parameter has its rotor; drag, so that wind has something to act on.
Vehicle octocopter() {
  Vehicle v;
  for (int n = 0; n < 8; ++n) {
    const double angle = 0.3 + n * M_PI / 4;
    v.rotors.push_back({.r_B = {0.2 * std::cos(angle), 0.2 * std::sin(angle), -0.03}, .s = n % 3 ? 1 : -1});
  }
  v.parameters = {
      {"m", {1.0, {}}},      {"kT", {6e-6, {}}},           {"kQ", {1e-7, {}}},  {"km", {900, {}}},
      {"omega_m", {25, {}}}, {"zeta_m", {0.9, {}}},        {"Jxx", {8e-3, {}}}, {"Jyy", {9e-3, {}}},
      {"Jzz", {1.5e-2, {}}}, {"rotor_drag.kd", {2e-5, {}}}};
  return v;
}

/// Commands up and down, a battery that falls, from 5 s after the start of the log.
FlightInputs inputs() {
  FlightInputs in;
  for (int n = 0; n < 8; ++n) {
    std::vector<double> t, delta;
    for (int i = 0; i < 60; ++i)
      t.push_back(5.0 + 0.004 * i), delta.push_back(0.5 + 0.2 * std::sin(0.4 * i + n));
    in.delta.push_back(HeldCommand(t, delta));
  }
  in.t = {5.0, 5.2}, in.voltage_ratio = {0.97, 0.93};
  return in;
}

template <class S>
FlightState<S> moving() {
  FlightState<S> x;
  const Vec4<double> q = Vec4<double>(0.95, 0.12, -0.18, 0.2).normalized();
  x.body = {Vec4<S>(S(q[0]), S(q[1]), S(q[2]), S(q[3])), Vec3<S>(S(0.8), S(-1.1), S(0.6)),
            Vec3<S>(S(3.0), S(-2.0), S(0.7)), Vec3<S>(S(0.0), S(0.0), S(-0.5))};
  for (auto& motor : x.motors) motor = {S(400.0), S(0.0)};
  return x;
}

/// On the ground, rotors off, nothing moves.
template <class S>
FlightState<S> resting() {
  FlightState<S> x = moving<S>();
  for (int i = 0; i < 4; ++i) x.body.q_WB[i] = S(i == 0 ? 1.0 : 0.0);
  for (int i = 0; i < 3; ++i) x.body.w_B[i] = x.body.v_W[i] = x.body.x_W[i] = S(0.0);
  for (auto& motor : x.motors) motor = {S(0.0), S(0.0)};
  return x;
}

/// All that an effect can change: the state after some steps, the IMU's readings and the sensors' delay.
template <class S, class Effects = EffectSet<S>>
std::vector<S> seen(const std::vector<S>& p, EffectMask mask, FlightState<S> x, int steps = 25) {
  const Vehicle vehicle = octocopter();
  const Effects effects(std::span<const S>(p), mask);
  const FlightInputs in = inputs();
  Flight<S, Effects> flight(vehicle, std::span<const S>(p), effects, in);
  double t = 5.0013;  // not on a sample of the command, where the derivative by a delay has a step
  for (int i = 0; i < steps; ++i, t += 0.004) x = flight.step(x, t, 0.004, flight.rate(x, t));
  const SensorSeam<S> imu = flight.imu(x.body.w_B, flight.rate(x, t));
  std::vector<S> all(x.body.q_WB.data(), x.body.q_WB.data() + 4);
  for (const Vec3<S>& v : {x.body.w_B, x.body.v_W, x.body.x_W, imu.f_B, imu.gyro})
    all.insert(all.end(), v.data(), v.data() + 3);
  for (std::size_t n = 0; n < 8; ++n) all.push_back(x.motors[n].Omega);
  all.push_back(flight.sensor_delay());
  return all;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

class Effect : public testing::TestWithParam<int> {
 protected:
  const EffectEntry& e() const { return entry(static_cast<EffectId>(GetParam())); }
  EffectMask mask() const { return mask_of(e().id) | mask_of(EffectId::rotor_drag); }
  std::size_t place(std::size_t i) const { return static_cast<std::size_t>(e().offset) + i; }
  static std::vector<double> null() { return parameter_vector(octocopter()); }

  /// A point at which parameter i acts: null, and the size of a payload for its place.
  std::vector<double> around(std::size_t i) const {
    std::vector<double> p = null();
    if (e().id == EffectId::payload && i > 0) p[place(0)] = e().parameters[0].typical;
    return p;
  }
};

TEST_P(Effect, SaysWhatItIs) {
  EXPECT_EQ(find_effect(e().info.name), &e());
  for (const std::string_view text :
       {e().info.name, e().info.equation, e().info.looks_like, e().info.confused_with, e().info.split_by})
    EXPECT_FALSE(text.empty());
  ASSERT_FALSE(e().parameters.empty());
  for (const EffectParameter& q : e().parameters) {
    const std::string name = std::string(e().info.name) + "." + std::string(q.name);
    EXPECT_EQ(parameter_unit(name), q.unit) << name;
    EXPECT_FALSE(q.unit.empty()) << name;
    EXPECT_EQ(default_value(name), q.null_value) << name;
    EXPECT_GT(q.typical, 0.0) << name;
    EXPECT_GT(q.limit, q.typical) << name;
    EXPECT_LT(q.limit, 1e6) << name << ": a range that excludes nothing";
  }
}

TEST_P(Effect, IsZeroAtItsNullValue) {
  const std::vector<double> p = null();
  const EffectMask plain = mask_of(EffectId::rotor_drag);
  // One evaluation is the same to rounding; a tenth of a second of flight to its accumulation.
  const auto off = seen(p, plain, moving<double>(), 0), on = seen(p, mask(), moving<double>(), 0);
  for (std::size_t i = 0; i < off.size(); ++i)
    EXPECT_NEAR(on[i], off[i], 1e-14 * (1 + std::abs(off[i]))) << i;
  const auto flown_off = seen(p, plain, moving<double>()), flown_on = seen(p, mask(), moving<double>());
  for (std::size_t i = 0; i < off.size(); ++i)
    EXPECT_NEAR(flown_on[i], flown_off[i], 1e-12 * (1 + std::abs(flown_off[i]))) << i;
}

TEST_P(Effect, IsOfFirstOrderThere) {
  for (std::size_t i = 0; i < e().parameters.size(); ++i) {
    const std::vector<double> p = around(i);
    const auto moved = [&](double share) {
      std::vector<double> other = p;
      other[place(i)] += share * e().parameters[i].typical;
      return seen(other, mask(), moving<double>());
    };
    const auto base = seen(p, mask(), moving<double>());
    const double small = distance(moved(0.001), base), twice = distance(moved(0.002), base);
    EXPECT_GT(small, 1e-9) << e().parameters[i].name;
    EXPECT_NEAR(twice / small, 2.0, 0.02) << e().parameters[i].name;
  }
}

TEST_P(Effect, DualDerivativesEqualCentralDifferencesInMotionAndNearTheGround) {
  for (std::size_t i = 0; i < e().parameters.size(); ++i) {
    const std::vector<double> p = around(i);
    const double h = 1e-4 * e().parameters[i].typical;
    std::vector<double> up = p, down = p;
    up[place(i)] += h, down[place(i)] -= h;
    std::vector<D> dual(p.begin(), p.end());
    dual[place(i)].seed(0);
    const auto exact = seen(dual, mask(), moving<D>());
    const auto a = seen(up, mask(), moving<double>()), b = seen(down, mask(), moving<double>());
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const double numeric = (a[k] - b[k]) / (2 * h);
      EXPECT_NEAR(exact[k].derivative(0), numeric, 1e-5 * std::abs(numeric) + 1e-9 / h)
          << e().parameters[i].name << " " << k;
    }
  }
}

// The same effects in a model that leaves nothing out.
template <class S>
struct Unabridged : EffectSet<S> {
  using EffectSet<S>::EffectSet;
  static constexpr unsigned touches() { return ~0U; }
};

TEST_P(Effect, TouchesNoMoreThanItSays) {
  std::vector<double> p = null();
  p[static_cast<std::size_t>(find_parameter("rotor_drag.kd")->index)] = 0.0;
  for (std::size_t i = 0; i < e().parameters.size(); ++i) p[place(i)] += e().parameters[i].typical;
  const auto said = seen(p, mask_of(e().id), moving<double>());
  const auto all = seen<double, Unabridged<double>>(p, mask_of(e().id), moving<double>());
  for (std::size_t i = 0; i < said.size(); ++i)
    EXPECT_NEAR(said[i], all[i], 1e-12 * (1 + std::abs(all[i]))) << i;
}

TEST_P(Effect, HasFiniteDerivativesAtRestWithRotorsOff) {
  const auto finite = [&](const std::vector<double>& p, const char* at) {
    std::vector<D> dual(p.begin(), p.end());
    FlightState<D> x = resting<D>();
    // Seeds one after the other: the effect's parameters, then the state.
    std::vector<D*> seeds;
    for (std::size_t i = 0; i < e().parameters.size(); ++i) seeds.push_back(&dual[place(i)]);
    for (int i = 0; i < 4; ++i) seeds.push_back(&x.body.q_WB[i]);
    for (int i = 0; i < 3; ++i)
      for (Vec3<D>* v : {&x.body.w_B, &x.body.v_W, &x.body.x_W}) seeds.push_back(&(*v)[i]);
    seeds.push_back(&x.motors[0].Omega), seeds.push_back(&x.motors[0].Omega_dot);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      seeds[i]->seed(0);
      for (const D& value : seen(dual, mask(), x, 1))
        EXPECT_TRUE(std::isfinite(value.v) && std::isfinite(value.derivative(0))) << at << ", seed " << i;
      *seeds[i] = D(seeds[i]->v);
    }
  };
  std::vector<double> p = null();
  finite(p, "null");
  for (std::size_t i = 0; i < e().parameters.size(); ++i) p[place(i)] += e().parameters[i].typical;
  finite(p, "typical size");
}

TEST_P(Effect, GoesThroughAVehicleFileUnchanged) {
  for (std::size_t i = 0; i < e().parameters.size(); ++i) {
    const EffectParameter& q = e().parameters[i];
    const std::string name = std::string(e().info.name) + "." + std::string(q.name);
    Vehicle vehicle = octocopter();
    vehicle.parameters[name] = {q.null_value + 1.3 * q.typical, 0.2 * q.typical};
    const Vehicle read = read_vehicle(write_text(test_folder(), "v.yaml", vehicle_to_yaml(vehicle)));
    ASSERT_TRUE(read.has(name)) << name;
    const Known before = vehicle.parameters[name], after = read.parameters.at(name);
    EXPECT_NEAR(after.value, before.value, 1e-15 * std::abs(before.value)) << name;
    ASSERT_TRUE(after.std) << name;
    EXPECT_NEAR(*after.std, *before.std, 1e-15 * *before.std) << name;
    EXPECT_NE(active_effects(parameter_vector(read)) & mask_of(e().id), 0U) << name;
  }
}

std::string name_of(const testing::TestParamInfo<int>& tested) {
  return std::string(entry(static_cast<EffectId>(tested.param)).info.name);
}
INSTANTIATE_TEST_SUITE_P(All, Effect, testing::Range(0, kEffectCount), name_of);

}  // namespace
}  // namespace ident
