// The whole vehicle in steps: hover stays, and derivatives by dual numbers equal central differences.
#include "ident/model/flight.h"

#include <gtest/gtest.h>

#include "ident/core/dual.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

struct Here {
  static constexpr int kBytes = 16;
};
using D = Dual<1, Here>;

Vehicle small_quad() {
  Vehicle v;
  v.rotors = layout_rotors("4sp", 0.2, 0.1);
  v.parameters = {{"m", {0.5, {}}},    {"kT", {6e-6, {}}},    {"kQ", {1e-7, {}}},
                  {"km", {900, {}}},   {"omega_m", {25, {}}}, {"zeta_m", {0.9, {}}},
                  {"Jxx", {3e-3, {}}}, {"Jyy", {3.2e-3, {}}}, {"Jzz", {5e-3, {}}},
                  {"Jp", {3e-6, {}}},  {"alpha", {0.1, {}}},  {"dead_time", {0.003, {}}}};
  return v;
}

FlightInputs commands(double level) {
  FlightInputs in;
  std::vector<double> t, d;
  for (int i = 0; i < 200; ++i) t.push_back(0.004 * i), d.push_back(level + 0.1 * std::sin(0.3 * i));
  for (int n = 0; n < 4; ++n) {
    std::vector<double> own = d;
    for (double& x : own) x += 0.02 * n;
    in.delta.push_back(HeldCommand(t, own));
  }
  return in;
}

template <class S>
FlightState<S> fly(const Vehicle& v, const std::vector<S>& p, EffectMask mask, int steps) {
  const EffectSet<S> effects(std::span<const S>(p), mask);
  const FlightInputs in = commands(0.5);
  Flight<S, EffectSet<S>> flight(v, p, effects, in);
  FlightState<S> x;
  x.body = {Vec4<S>(S(1), S(0), S(0), S(0)), Vec3<S>(S(0), S(0), S(0)), Vec3<S>(S(0.5), S(0), S(0)),
            Vec3<S>(S(0), S(0), S(-1))};
  for (auto& motor : x.motors) motor = {S(400.0), S(0.0)};
  double t = 0.1;
  for (int i = 0; i < steps; ++i, t += 0.004) x = flight.step(x, t, 0.004, flight.rate(x, t));
  return x;
}

TEST(Flight, DualDerivativesEqualCentralDifferencesForEveryParameter) {
  const Vehicle v = small_quad();
  const std::vector<double> p = parameter_vector(v);
  for (const ParameterInfo& info : all_parameters()) {
    const auto i = static_cast<std::size_t>(info.index);
    EffectMask mask = 0;
    for (const EffectEntry& e : catalogue())
      if (info.index >= e.offset && info.index < e.offset + static_cast<int>(e.parameters.size()))
        mask = mask_of(e.id);
    std::vector<D> dual(p.begin(), p.end());
    dual[i].seed(0);
    const FlightState<D> x = fly(v, dual, mask, 20);
    const double size = p[i] != 0.0 ? std::abs(p[i]) : info.unit == "kg m^2" ? 1e-5 : 1e-2;
    const double h = 1e-4 * size;
    std::vector<double> up = p, down = p;
    up[i] += h, down[i] -= h;
    const auto a = fly(v, up, mask, 20), b = fly(v, down, mask, 20);
    for (int k = 0; k < 3; ++k) {
      const double numeric = (a.body.w_B[k] - b.body.w_B[k]) / (2 * h), exact = x.body.w_B[k].derivative(0);
      EXPECT_NEAR(exact, numeric, 2e-4 * std::abs(numeric) + 1e-11 / h) << info.name << " w" << k;
      const double numeric_v = (a.body.v_W[k] - b.body.v_W[k]) / (2 * h),
                   exact_v = x.body.v_W[k].derivative(0);
      EXPECT_NEAR(exact_v, numeric_v, 2e-4 * std::abs(numeric_v) + 1e-11 / h) << info.name << " v" << k;
    }
  }
}

TEST(Flight, EveryEffectDoesNothingAtItsNullValue) {
  const Vehicle v = small_quad();
  const std::vector<double> p = parameter_vector(v);
  const auto plain = fly(v, p, 0, 20);
  for (const EffectEntry& e : catalogue()) {
    const auto x = fly(v, p, mask_of(e.id), 20);
    EXPECT_LT((x.body.w_B - plain.body.w_B).norm(), 1e-12) << e.info.name;
    EXPECT_LT((x.body.v_W - plain.body.v_W).norm(), 1e-12) << e.info.name;
  }
}

// What turns the vehicle from outside is a moment: products of inertia couple it to the other axes.
TEST(Flight, GustsTurnAsMomentsDo) {
  Vehicle v = small_quad();
  v.parameters["Jxz"] = {4e-4, {}}, v.parameters["Jyz"] = {-3e-4, {}};
  const std::vector<double> p = parameter_vector(v);
  const NoEffects none;
  const Body<double> body(v, p, none);
  const BodyState<double> state{Vec4<double>(1, 0, 0, 0), Vec3<double>(0.3, -0.2, 0.5), Vec3<double>::Zero(),
                                Vec3<double>(0, 0, -1)};
  const std::vector<MotorState<double>> motors(4, {400.0, 0.0});
  Disturbance<double> gust;
  gust.w_dot_B = {0.7, -1.1, 0.4};
  const Vec3<double> turned =
      body.rate(state, std::span(motors), &gust).w_dot_B - body.rate(state, std::span(motors)).w_dot_B;
  const Vec3<double> moment = body.J().diagonal().cwiseProduct(gust.w_dot_B);
  EXPECT_LT((body.J() * turned - moment).norm(), 1e-12);
  EXPECT_GT(std::abs(turned[2] - gust.w_dot_B[2]), 0.01);
}

// A motor of first order as a file states it: zeta_m = 50. Its fast pole settles in 2 us.
struct FirstOrderMotors {
  FirstOrderMotors() {
    p[param::omega_m] = 2000.0, p[param::zeta_m] = 50.0;
    for (std::size_t n = 0; n < 4; ++n) motors[n] = {350.0 + 20.0 * static_cast<double>(n), 4e4};
  }
  const Vehicle v = small_quad();
  std::vector<double> p = parameter_vector(v);
  const NoEffects none{};
  const FlightInputs in = commands(0.5);
  std::array<MotorState<double>, kMaxRotors> motors{};
  Flight<double> flight() { return {v, p, none, in}; }
};

TEST(Flight, WithoutItsFastModeAMotorGoesWhereItWouldHaveGone) {
  FirstOrderMotors first;
  Flight<double> flight = first.flight();
  auto with = first.motors, without = first.motors;
  flight.drop_fast_mode(without, 0.1, 0.0025);
  EXPECT_GT(std::abs(without[0].Omega - with[0].Omega), 0.1);  // 4e4/2e5 rad/s of it dies away
  flight.advance(with, 0.1, 5e-4), flight.advance(without, 0.1, 5e-4);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_NEAR(with[n].Omega, without[n].Omega, 1e-8);
    EXPECT_NEAR(with[n].Omega_dot, without[n].Omega_dot, 1e-6);
  }
  auto again = without;
  flight.drop_fast_mode(again, 0.1005, 0.0025);
  EXPECT_NEAR(again[0].Omega, without[0].Omega, 1e-8);  // there is none any more
}

TEST(Flight, AMotorOfSecondOrderKeepsItsState) {
  FirstOrderMotors second;
  second.p[param::omega_m] = 25.0, second.p[param::zeta_m] = 1.5;
  auto motors = second.motors;
  second.flight().drop_fast_mode(motors, 0.1, 0.0025);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(motors[n].Omega, second.motors[n].Omega);
    EXPECT_EQ(motors[n].Omega_dot, second.motors[n].Omega_dot);
  }
}

}  // namespace
}  // namespace ident
