// Rotor speeds as input: noise comes off, motion stays, and what depends on the smoothing is told.
#include "ident/flight/conditioning/speed_smoother.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/random.h"
#include "ident/flight/conditioning/speed_modes.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/make_record.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/flight/smoother/input_error.h"
#include "ident/sim/simulate.h"
#include "support/known_quad.h"
#include "support/published_hover.h"

namespace ident {
namespace {

struct Speed {
  std::vector<double> t, truth, seen;
};

Speed speed_of(double noise, int rows = 5000, double rate = 250) {
  Speed s;
  Random random(11);
  for (int i = 0; i < rows; ++i) {
    const double t = i / rate;
    s.t.push_back(t);
    s.truth.push_back(900 + 40 * std::sin(7 * t) + 15 * std::sin(23 * t + 1));
    s.seen.push_back(s.truth.back() + noise * random.normal());
  }
  return s;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Slope of the true rate over the one that the smoothed speeds have: 1 where noise weakens nothing.
double slope_of_rates(const Speed& s, const std::vector<double>& by) {
  double xy = 0, xx = 0;
  for (std::size_t i = 1; i < by.size(); ++i) {
    const double x = by[i] - by[i - 1], y = s.truth[i] - s.truth[i - 1];
    xy += x * y, xx += x * x;
  }
  return xy / xx;
}

TEST(SpeedSmoother, RemovesNoiseAndKeepsTheMotion) {
  const Speed s = speed_of(3.0);
  const SmoothedSpeed found = smoothed_speed(s.t, s.seen);
  EXPECT_LT(rms(found.likely, s.truth), 1.0);
  EXPECT_LT(slope_of_rates(s, s.seen), 0.3);
  EXPECT_NEAR(slope_of_rates(s, found.likely), 1.0, 0.03);
  EXPECT_LT(slope_of_rates(s, found.rougher), slope_of_rates(s, found.likely));
}

// The error in the mean square, and that of means over a quarter of a second, as stated.
TEST(SpeedSmoother, GivesItsOwnErrorVariance) {
  const Speed s = speed_of(3.0, 20000);
  const SmoothedSpeed found = smoothed_speed(s.t, s.seen);
  double square = 0, stated = 0, of_means = 0, stated_of_means = 0;
  constexpr std::size_t kWindow = 62;
  for (std::size_t from = 0; from + kWindow <= s.t.size(); from += kWindow) {
    double mean = 0;
    for (std::size_t i = from; i < from + kWindow; ++i) {
      const double e = found.likely[i] - s.truth[i];
      square += e * e, stated += found.variance[i], mean += e / kWindow;
    }
    of_means += mean * mean, stated_of_means += found.density[from] / (kWindow / 250.0);
  }
  EXPECT_NEAR(square / stated, 1.0, 0.4);
  EXPECT_NEAR(of_means / stated_of_means, 1.0, 0.4);
}

TEST(SpeedSmoother, LeavesExactSpeedsAlone) {
  const Speed s = speed_of(0.0);
  EXPECT_LT(rms(smoothed_speed(s.t, s.seen).likely, s.truth), 1e-3);
  const std::vector<double> still(s.t.size(), 700.0);
  EXPECT_EQ(smoothed_speed(s.t, still).likely, still);
}

TEST(SpeedSmoother, BridgesHeldAndMissingSamples) {
  Speed s = speed_of(1.0);
  for (std::size_t i = 0; i < s.seen.size(); ++i) {
    if (i % 4 != 0) s.seen[i] = s.seen[i - 1];
    if (i > 2000 && i < 2010) s.seen[i] = kNaN;
  }
  EXPECT_LT(rms(smoothed_speed(s.t, s.seen).likely, s.truth), 1.0);
  const std::vector<double> none(s.t.size(), kNaN);
  EXPECT_TRUE(smoothed_speed(s.t, none).likely.empty());
}

// A motor that hovers and is then driven hard: one smoothing for both takes the edges of what it does for
// noise, or noise for what it does.
TEST(SpeedSmoother, FollowsBurstsAndSmoothsWhatIsCalm) {
  Speed s;
  Random random(3);
  double speed = 800;
  std::vector<double> calm, burst, calm_found, burst_found;
  for (int i = 0; i < 6000; ++i) {
    const double t = i / 250.0;
    const bool driven = std::fmod(t, 4.0) > 3.2;
    const double target = driven ? 800 + (std::fmod(t, 0.4) < 0.2 ? 60 : -60) : 800 + 2 * std::sin(2 * t);
    speed += (target - speed) * 0.1;
    s.t.push_back(t), s.truth.push_back(speed), s.seen.push_back(speed + 3.0 * random.normal());
  }
  const SmoothedSpeed found = smoothed_speed(s.t, s.seen);
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    const double phase = std::fmod(s.t[i], 4.0);
    const bool driven = phase > 3.2, settled = phase > 0.6 && phase < 3.0;
    if (driven) burst.push_back(s.truth[i]), burst_found.push_back(found.likely[i]);
    if (settled) calm.push_back(s.truth[i]), calm_found.push_back(found.likely[i]);
  }
  EXPECT_LT(rms(calm, calm_found), 0.15 * 3.0);
  EXPECT_LT(rms(burst, burst_found), 0.65 * 3.0);
}

// Hover, then a sudden stop, or a sample that is false: every row keeps a number, and a false sample its
// neighbours.
TEST(SpeedSmoother, SurvivesASuddenStopAndAFalseSample) {
  for (const double noise : {0.2, 3.0}) {
    Speed stop, slip;
    Random random(5);
    double speed = 800;
    for (int i = 0; i < 10000; ++i) {
      const double t = i / 250.0;
      if (t > 30) speed += (200 - speed) * 0.25;
      const double e = noise * random.normal();
      stop.t.push_back(t), stop.truth.push_back(speed), stop.seen.push_back(speed + e);
      const bool is_false = i == 7000 || i == 7001;
      slip.t.push_back(t), slip.truth.push_back(800), slip.seen.push_back(is_false ? 1.5 : 800 + e);
    }
    for (const Speed& s : {stop, slip}) {
      const SmoothedSpeed found = smoothed_speed(s.t, s.seen);
      EXPECT_LT(rms(found.likely, s.truth), noise) << noise;
      EXPECT_LT(rms(found.rougher, s.truth), noise) << noise;
    }
    EXPECT_NEAR(smoothed_speed(slip.t, slip.seen).likely[7000], 800, noise);
  }
}

// A motor that shakes more later on.
TEST(SpeedSmoother, NoiseMayChange) {
  Speed s;
  Random random(9);
  std::vector<double> truth, later;
  for (int i = 0; i < 12000; ++i) {
    const double t = i / 250.0, noise = t < 17 ? 0.6 : 3.2;
    s.t.push_back(t), s.truth.push_back(800 + 5 * std::sin(2 * t));
    s.seen.push_back(s.truth.back() + noise * random.normal());
  }
  const std::vector<double> found = smoothed_speed(s.t, s.seen).likely;
  for (std::size_t i = 8000; i < 12000; ++i) truth.push_back(s.truth[i]), later.push_back(found[i]);
  EXPECT_LT(rms(truth, later), 0.3 * 3.2);
}

// Few speeds in rows of other sensors, the first of them late.
TEST(SpeedSmoother, FewSpeedsAmongManyRowsAreSmoothedToo) {
  Speed s;
  Random random(4);
  for (int i = 0; i < 60000; ++i) {
    const double t = i / 1000.0;
    s.t.push_back(t), s.truth.push_back(800 + 20 * std::sin(t));
    s.seen.push_back(i > 4100 && i % 20 == 0 ? s.truth.back() + 3.0 * random.normal() : kNaN);
  }
  const std::vector<double> found = smoothed_speed(s.t, s.seen).likely;
  std::vector<double> truth(s.truth.begin() + 5000, s.truth.end()), flown(found.begin() + 5000, found.end());
  EXPECT_LT(rms(flown, truth), 0.5 * 3.0);
}

// Of two flights through still air: speeds with one per cent of noise, no commands.
std::vector<FlightLog> flights_by_noisy_speeds(const Vehicle& truth) {
  std::vector<FlightLog> logs;
  Random random(5);
  for (const std::uint64_t seed : {1, 2}) {
    SimulationOptions options;
    options.rate = 250, options.duration = 30, options.seed = seed, options.signals.rotor_speeds = 1;
    FlightLog log = simulate_flight(truth, options).log;
    log.file = "log" + std::to_string(seed);
    log.delta.clear();
    for (auto& column : log.Omega)
      for (double& Omega : column) Omega *= 1 + 0.01 * random.normal();
    logs.push_back(std::move(log));
  }
  return logs;
}

// The error of a rotor, or of rotors together, turns and pushes the vehicle by as much as the model does with
// speeds that are off by it.
TEST(SpeedSmoother, ErrorsOfTheInputActAsTheModelSays) {
  const Vehicle vehicle = testing::published_vehicle();  // two rotors are slanted
  const std::vector<double> p = parameter_vector(vehicle);
  SimulationOptions options;
  options.rate = 100, options.duration = 3, options.scenario = "hover", options.signals.rotor_speeds = 1;
  FlightLog log = simulate_flight(vehicle, options).log;
  log.delta.clear();
  FlightRecord record = make_flight_record(vehicle, p, std::span(&log, 1));
  FlightArc& arc = record.arcs.at(0);
  const EffectSet<double> effects(p, active_effects(p));
  const auto accelerations_with = [&](const FlightInputs& inputs) {
    FlightState<double> x = arc.start(100);
    const BodyRate<double> rate =
        Flight<double, EffectSet<double>>(vehicle, p, effects, inputs).rate(x, arc.t[100]);
    AccelerationVariance a;
    a << rate.w_dot_B, rate.v_dot_W;
    return a;
  };
  constexpr double kOff = 0.01;
  const Eigen::MatrixXd of_vehicle = speed_modes(vehicle, p), none;
  for (const bool by_mode : {false, true}) {
    std::vector<AccelerationVariance> expected, found;
    AccelerationVariance most = AccelerationVariance::Zero();
    for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) {
      SpeedErrors errors{arc.t, {}, {}, {}, by_mode ? of_vehicle : none};
      for (auto* of : {&errors.variance, &errors.density, &errors.other})
        of->assign(vehicle.rotors.size(), std::vector<double>(arc.rows(), 0.0));
      errors.variance[n].assign(arc.rows(), 4.0), errors.density[n].assign(arc.rows(), 1e6);
      arc.speed_errors = std::make_shared<const SpeedErrors>(errors);
      FlightInputs off = *arc.inputs;
      for (std::size_t k = 0; k < off.Omega.size(); ++k) {
        const double share = by_mode ? of_vehicle(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k))
                                     : static_cast<double>(k == n);
        for (double& Omega : off.Omega[k]) Omega += share * kOff;
      }
      const AccelerationVariance slope = (accelerations_with(off) - accelerations_with(*arc.inputs)) / kOff;
      expected.emplace_back(4.0 * slope.cwiseAbs2());
      found.push_back(input_error(record, arc, 100, 101, GustAxes::world));
      most = most.cwiseMax(found.back());
    }
    for (std::size_t n = 0; n < found.size(); ++n)
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(found[n][i], expected[n][i],
                    0.03 * found[n][i] + 2e-3 * most[i] + 1e-4 * found[n].maxCoeff())
            << n << i << by_mode;
  }
}

// What is left of their noise rolls and pitches the vehicle in the model, not in the air. (About the yaw axis
// it is the spin-up that counts here.)
TEST(SpeedSmoother, InputErrorsAreNotEstimatedAsGusts) {
  const Vehicle truth = testing::quad(), stated = testing::known(truth);
  const std::vector<FlightLog> logs = flights_by_noisy_speeds(truth);
  const std::vector<double> p = parameter_vector(stated);
  const FlightRecord record = make_flight_record(stated, p, logs);
  std::vector<FreeConstant> constants = free_constants(stated, p);
  leave_out_motors(constants);
  const Theta theta(p, constants, record.logs, true);
  const FlightFit fit = fit_flight(record, theta);
  const InputErrorProcess error = input_error_process(record, GustAxes::world);
  for (const AirNoise& air : fit.noise.air)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LT(air.w_dot[i].sigma, 0.5 * std::sqrt(error.variance[static_cast<Eigen::Index>(i)])) << i;
  // Without the errors all of it is gusts.
  FlightRecord blind = record;
  for (FlightArc& arc : blind.arcs) arc.speed_errors = nullptr;
  const FlightFit other = fit_flight(blind, theta);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_GT(other.noise.air[0].w_dot[i].sigma, 2 * fit.noise.air[0].w_dot[i].sigma) << i;
}

// Taken as they are, such speeds make Jp and the inertias wrong by many standard deviations.
TEST(SpeedSmoother, NoisySpeedsAsInputGiveNoConfidentWrongNumber) {
  const Vehicle truth = testing::quad();
  const std::vector<FlightLog> logs = flights_by_noisy_speeds(truth);
  const Result result = refine_flight(testing::known(truth), logs, {.validate = false});
  int known = 0;
  for (const Parameter& p : result.parameters) {
    EXPECT_LT(std::abs(p.value - truth.value(p.name)), 3.5 * p.std) << p.name;
    known += p.identifiable;
  }
  EXPECT_GE(known, 3);
  EXPECT_TRUE(
      std::ranges::any_of(result.warnings, [](const Warning& w) { return w.code == "speeds_as_input"; }));
}

}  // namespace
}  // namespace ident
