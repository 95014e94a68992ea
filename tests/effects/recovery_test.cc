// Every effect of effects.def, put into a simulated flight, is found again by the flight estimator.
#include <gtest/gtest.h>

#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_noise.h"
#include "ident/flight/make_record.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

/// Half a kilogram with drag (wind acts through it) and a battery; what the bench knows to a few percent.
Vehicle quadrotor() {
  Vehicle v;
  v.rotors = layout_rotors("x", 0.17, 0.0);
  for (Rotor& rotor : v.rotors) rotor.r_B[2] = -0.03;
  v.battery_voltage = 11.1;
  v.parameters = {{"m", {0.5, 0.001}},     {"kT", {6e-6, 6e-8}},      {"kQ", {9e-8, 2e-9}},
                  {"km", {850, 5.0}},      {"omega_m", {30, 1.0}},    {"zeta_m", {0.9, 0.03}},
                  {"Jxx", {3e-3, 1.5e-4}}, {"Jyy", {3.2e-3, 1.5e-4}}, {"Jzz", {5.4e-3, 2.5e-4}}};
  v.parameters["rotor_drag.kd"] = {3e-5, {}};
  return v;
}

/// The parameters of an effect that make one cause: of numbered ones those of rotor 2.
std::vector<std::size_t> one_cause(const EffectEntry& e) {
  std::vector<std::size_t> numbered, all;
  for (std::size_t i = 0; i < e.parameters.size(); ++i) {
    if (e.parameters[i].name.ends_with("@2")) numbered.push_back(i);
    all.push_back(i);
  }
  return numbered.empty() ? all : numbered;
}

FlightLog flown(const Vehicle& vehicle) {
  SimulationOptions options;
  options.scenario = "mixed";
  options.duration = 16.0;
  options.rate = 100.0;
  options.noise = noise_level("none");
  options.longest_step = 0.0;  // the estimator's own integrator: what is left over is not its error
  return simulate_flight(vehicle, options).log;
}

/// Levels of ordinary sensors: a clean log has to be weighed by something. The process noise with which every
/// fit starts keeps a model that lacks the effect near the measurements.
NoiseModel usual_noise(const FlightRecord& record) {
  NoiseModel noise = initial_noise(record);
  const SensorNoise sensor = noise_level("typical");
  const auto set = [&](int first, double std) {
    for (int k = 0; k < 3; ++k) noise.sigma[static_cast<std::size_t>(first + k)] = std;
  };
  set(kGyro, sensor.gyro), set(kForce, sensor.accelerometer), set(kAttitude, sensor.attitude);
  set(kVelocity, sensor.velocity), set(kPosition, sensor.position);
  for (std::size_t n = kRotorChannel; n < kChannels; ++n) noise.sigma[n] = 1.0;
  return noise;
}

/// Estimates from one log with these parameters free and the bench as priors; the search starts at the null.
std::vector<double> refitted(const Vehicle& vehicle, const FlightLog& log,
                             const std::vector<std::string>& free) {
  const std::vector<double> p = parameter_vector(vehicle);
  const std::vector<FlightLog> logs{log};
  const FlightRecord record = make_flight_record(vehicle, p, logs);
  const Theta theta(p, free_constants(vehicle, p, free), 1, true);
  FlightFitOptions options;
  options.estimate_noise = false;
  options.robust = false;
  options.noise = usual_noise(record);
  options.chunk_seconds = 0.5;
  options.tolerance = 1e-12;
  return theta.p(fit_flight(record, theta, options).u);
}

class Recovery : public testing::TestWithParam<int> {};

TEST_P(Recovery, FindsTheEffectInAFlightThatHasIt) {
  const EffectEntry& e = entry(static_cast<EffectId>(GetParam()));
  Vehicle truth = quadrotor(), known = quadrotor();
  std::vector<std::string> names;
  for (const std::size_t i : one_cause(e)) {
    const EffectParameter& q = e.parameters[i];
    names.push_back(std::string(e.info.name) + "." + std::string(q.name));
    truth.parameters[names.back()] = {
        q.null_value + (i % 2 && q.range == Range::any ? -1.0 : 1.0) * q.typical, {}};
    if (e.id == EffectId::rotor_drag) known.parameters.erase(names.back());
  }
  // At zero mass the place of a payload acts on nothing: the search starts at a mass that it surpasses.
  if (e.id == EffectId::payload) known.parameters["payload.m"] = {0.5 * e.parameters[0].typical, {}};
  // The estimator is linear in a sensor delay: it leaves out tau^2/2 of the second derivatives.
  const double tolerance = e.id == EffectId::sensor_delay ? 0.03 : 0.01;
  const std::vector<double> p = refitted(known, flown(truth), names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const EffectParameter& q = e.parameters[one_cause(e)[k]];
    const double found = p[static_cast<std::size_t>(find_parameter(names[k])->index)];
    EXPECT_NEAR(found, truth.value(names[k]), tolerance * q.typical) << names[k];
  }
}

std::string name_of(const testing::TestParamInfo<int>& tested) {
  return std::string(entry(static_cast<EffectId>(tested.param)).info.name);
}
INSTANTIATE_TEST_SUITE_P(All, Recovery, testing::Range(0, kEffectCount), name_of);

}  // namespace
}  // namespace ident
