// Refinement finds the truth again: from exact logs, from the published flight, and with what sensors do to
// it.
#include "ident/flight/refine.h"

#include <gtest/gtest.h>

#include "ident/core/error.h"
#include "ident/flight/make_record.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/flight/verify.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/simulate.h"

namespace ident {
namespace {

const std::vector<std::string> kUnknown = {"kT", "kQ", "km", "omega_m", "zeta_m", "Jxx", "Jyy", "Jzz", "Jp"};

Vehicle feasible() {
  Vehicle v = read_vehicle(IDENT_SOURCE_DIR "/data/published/phang_4sp_feasible.yaml");
  v.command.reset();  // commands need not be whole microseconds
  return v;
}

/// Constants 3 % off, known to 10 %.
Vehicle as_measured(Vehicle v) {
  double sign = 1.0;
  for (const std::string& name : kUnknown) {
    const double value = v.value(name);
    v.parameters[name] = {value * (1 + 0.03 * sign), 0.1 * value};
    sign = -sign;
  }
  return v;
}

std::vector<FlightLog> flights(const Vehicle& v, SimulationOptions options, int count = 1) {
  std::vector<FlightLog> logs;
  for (int i = 0; i < count; ++i) {
    options.seed = static_cast<std::uint64_t>(i + 1);
    logs.push_back(simulate_flight(v, options).log);
  }
  return logs;
}

void expect_found(const Result& result, const Vehicle& truth, double within) {
  for (const std::string& name : kUnknown) {
    const Parameter* p = result.find(name);
    ASSERT_TRUE(p) << name;
    EXPECT_TRUE(p->identifiable) << name;
    EXPECT_NEAR(p->value / truth.value(name), 1.0, within) << name << " +- " << p->std;
  }
}

void expect_within(const Result& result, const std::string& name, double truth, double stds) {
  const Parameter* p = result.find(name);
  ASSERT_TRUE(p) << name;
  EXPECT_TRUE(p->identifiable) << name;
  EXPECT_NEAR(p->value, truth, stds * p->std) << name;
}

TEST(FlightRefine, ExactLogsGiveTheConstantsBack) {
  SimulationOptions options;
  options.duration = 15.0;
  options.noise = noise_level("none");
  options.longest_step = 0.0;
  const Vehicle truth = feasible();
  expect_found(refine_flight(as_measured(truth), flights(truth, options), {.validate = false}), truth, 1e-8);
}

TEST(FlightRefine, ExactLogsOfAFinerIntegratorGiveTheConstantsBackButForTheStep) {
  SimulationOptions options;
  options.duration = 15.0;
  options.noise = noise_level("none");
  const Vehicle truth = feasible();
  expect_found(refine_flight(as_measured(truth), flights(truth, options), {.validate = false}), truth, 1e-5);
}

// As printed, the published vehicle has moments of inertia that no body has.
TEST(FlightRefine, AnInertiaThatNoBodyHasIsNamed) {
  SimulationOptions options;
  options.duration = 15.0;
  Vehicle truth = feasible();
  EXPECT_FALSE(refine_flight(as_measured(truth), flights(truth, options), {.validate = false})
                   .has_warning("triangle_inequality"));
  truth.parameters.at("Jzz").value = 2.423e-3;
  EXPECT_TRUE(refine_flight(as_measured(truth), flights(truth, options), {.validate = false})
                  .has_warning("triangle_inequality"));
}

// A plate has Jzz = Jxx + Jyy: noise, and a bench value of kQ that is a little off, put fits beyond that, and
// no estimate.
TEST(FlightRefine, AFlatVehicleIsStillABody) {
  SimulationOptions options;
  options.duration = 15.0;
  Vehicle truth = feasible();
  truth.parameters.at("Jzz").value = truth.value("Jxx") + truth.value("Jyy");
  Vehicle measured = as_measured(truth);
  measured.parameters.at("Jzz").value = 0.99 * (measured.value("Jxx") + measured.value("Jyy"));
  int beyond = 0;
  for (const std::uint64_t seed : {1, 2}) {
    options.seed = seed;
    const FlightLog log = simulate_flight(truth, options).log;
    const Result result = refine_flight(measured, std::span(&log, 1), {.validate = false});
    beyond += result.has_warning("triangle_inequality");
    const double sum = result.find("Jxx")->value + result.find("Jyy")->value;
    EXPECT_LE(result.find("Jzz")->value, sum * (1 + 1e-8));
    for (const char* moment : {"Jxx", "Jyy", "Jzz"}) expect_within(result, moment, truth.value(moment), 4.0);
  }
  EXPECT_GT(beyond, 0);  // else nothing was moved
}

TEST(FlightRefine, AMomentsPathWithoutRatesAndAttitudeIsRefusedInSoManyWords) {
  SimulationOptions options;
  options.duration = 5.0;
  std::vector<FlightLog> logs = flights(feasible(), options);
  logs[0].w_B = {}, logs[0].f_B = {}, logs[0].q_WB = {}, logs[0].Omega = {};
  try {
    refine_flight(as_measured(feasible()), logs);
    ADD_FAILURE() << "was refined";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("neither rates nor attitude"), std::string::npos)
        << error.what();
  }
}

TEST(FlightRefine, DeadTimeThatIsNoMultipleOfTheRowsLeavesNoBias) {
  SimulationOptions options;
  options.duration = 15.0;
  options.noise = noise_level("none");
  Vehicle truth = feasible();
  truth.parameters["dead_time"] = {0.0053, {}};
  Vehicle measured = as_measured(truth);
  measured.parameters["dead_time"] = {0.005, 0.001};
  const Result result = refine_flight(measured, flights(truth, options), {.validate = false});
  expect_found(result, truth, 2e-4);
  EXPECT_NEAR(result.find("dead_time")->value, 0.0053, 1e-6);
}

// [Phang] Figs. 7-8: 1 Hz sinusoids on opposing rotors.
TEST(FlightRefine, ThePublishedVehicleIsFoundFromItsPublishedManoeuvre) {
  SimulationOptions options;
  options.duration = 30.0;
  options.scenario = "phang";
  const Vehicle truth = feasible();
  const std::vector<FlightLog> logs = flights(truth, options);
  const Result verified = verify_flight(truth, logs);
  for (const char* channel : {"p", "q"}) {
    EXPECT_GT(verified.fit["channels"][channel]["fit_percent"].get<double>(), 80.0) << channel;
    EXPECT_LT(verified.fit["channels"][channel]["theil"].get<double>(), 0.15) << channel;
  }
  const Result result = refine_flight(as_measured(truth), logs, {.validate = false});
  for (const char* name : {"kT", "km", "omega_m", "Jxx", "Jyy"})
    expect_within(result, name, truth.value(name), 4.0);
}

// A vehicle file whose inertia is in other units: what is left of the flight is no number.
TEST(FlightRefine, DivergedSimulationsAreCountedAndLeftOut) {
  SimulationOptions options;
  options.duration = 10.0;
  Vehicle wrong = feasible();
  const std::vector<FlightLog> logs = flights(wrong, options);
  EXPECT_EQ(verify_flight(wrong, logs).fit["ran_away"], 0);
  for (const char* J : {"Jxx", "Jyy", "Jzz"}) wrong.parameters.at(J).value *= 1e-3;
  const Result verified = verify_flight(wrong, logs);
  const int lost = verified.fit["ran_away"], windows = verified.fit["windows"];
  EXPECT_GT(lost, 0);
  EXPECT_NE(verified.verdict.find(std::to_string(lost) + " of the " + std::to_string(windows)),
            std::string::npos)
      << verified.verdict;
  for (const auto& [channel, errors] : verified.fit["channels"].items())
    EXPECT_LT(errors["rms"].get<double>(), 1e6) << channel;
}

TEST(FlightRefine, DelayOfTheSensorsIsFoundWithoutBias) {
  SimulationOptions options;
  options.duration = 30.0;
  Vehicle truth = feasible();
  truth.parameters["sensor_delay.tau"] = {0.005, {}};
  const Result result = refine_flight(as_measured(feasible()), flights(truth, options),
                                      {.free = {"sensor_delay.tau"}, .validate = false});
  expect_within(result, "sensor_delay.tau", 0.005, 4.0);
  EXPECT_NEAR(result.find("sensor_delay.tau")->value, 0.005, 3e-5);
}

TEST(FlightRefine, DelayOfTheCommandsIsFound) {
  SimulationOptions options;
  options.duration = 30.0;
  Vehicle truth = feasible();
  truth.parameters["motor_delay.tau"] = {0.008, {}};
  const Result result = refine_flight(as_measured(feasible()), flights(truth, options),
                                      {.free = {"motor_delay.tau"}, .validate = false});
  expect_within(result, "motor_delay.tau", 0.008, 4.0);
  EXPECT_NEAR(result.find("motor_delay.tau")->value, 0.008, 1e-4);
}

TEST(FlightRefine, PlaceAndBiasOfTheAccelerometerAreFound) {
  SimulationOptions options;
  options.duration = 40.0;
  Vehicle truth = feasible();
  const std::vector<std::pair<std::string, double>> hidden = {
      {"imu_lever_arm.x", 0.03}, {"imu_lever_arm.y", -0.02}, {"imu_lever_arm.z", 0.015},
      {"imu_bias.ax", 0.2},      {"imu_bias.ay", -0.15},     {"imu_bias.az", 0.1}};
  RefineOptions refine{.validate = false};
  for (const auto& [name, value] : hidden) truth.parameters[name] = {value, {}}, refine.free.push_back(name);
  const Result result = refine_flight(as_measured(feasible()), flights(truth, options), refine);
  for (const auto& [name, value] : hidden) expect_within(result, name, value, 4.0);
  EXPECT_NEAR(result.find("imu_bias.ax")->value, 0.2, 0.01);
  EXPECT_NEAR(result.find("imu_lever_arm.z")->value, 0.015, 0.003);
}

const std::vector<std::string> kProducts = {"Jxy", "Jxz", "Jyz"};

TEST(FlightRefine, ProductsOfInertiaAreFound) {
  SimulationOptions options;
  options.duration = 40.0;
  Vehicle truth = feasible();
  truth.parameters["Jxy"] = {-2e-4, {}}, truth.parameters["Jxz"] = {0.7e-4, {}},
  truth.parameters["Jyz"] = {-0.5e-4, {}};  // still a body
  const Result result =
      refine_flight(as_measured(feasible()), flights(truth, options), {.free = kProducts, .validate = false});
  for (const std::string& name : kProducts) expect_within(result, name, truth.value(name), 4.0);
  EXPECT_NEAR(result.find("Jxy")->value, -2e-4, 1e-5);
}

TEST(Theta, AnInertiaThatIsNotPositiveDefiniteIsNotPossible) {
  const Vehicle v = feasible();
  const std::vector<double> p = parameter_vector(v);
  const Theta theta(p, free_constants(v, p, {"Jxy"}), 1, true);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  EXPECT_TRUE(theta.possible(u));
  const int last = theta.constants_count() - 1;
  const double border = std::sqrt(v.value("Jxx") * v.value("Jyy")) / theta.slope(u, last);
  for (const double sign : {-1.0, 1.0}) {
    u[last] = sign * 0.99 * border;
    EXPECT_TRUE(theta.possible(u));
    u[last] = sign * 1.01 * border;
    EXPECT_FALSE(theta.possible(u));
  }
}

// Against a prior of 60 % an inertia once went to 1e-32 for the price of less than two deviations.
TEST(Theta, PositiveConstantsDoNotVanishAgainstAWeakPrior) {
  Vehicle v = feasible();
  v.parameters["Jxx"].std = 0.6 * v.value("Jxx");
  const std::vector<double> p = parameter_vector(v);
  const Theta theta(p, free_constants(v, p), 1, true);
  int Jxx = 0;
  while (theta.name(Jxx) != "Jxx") ++Jxx;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
  const auto at = [&](double share) {
    u[Jxx] = std::log(share);
    const PriorTerms prior = theta.prior(u);
    return std::pair{prior.residual[Jxx], prior.slope[Jxx]};
  };
  EXPECT_NEAR(at(0.5).first, -0.5 / 0.6, 1e-12);
  EXPECT_NEAR(at(0.1 + 1e-9).first, at(0.1 - 1e-9).first, 1e-8);
  EXPECT_NEAR(at(0.1 + 1e-9).second, at(0.1 - 1e-9).second, 1e-8);
  EXPECT_LT(at(1e-32).first, -10.0);
  u[theta.size() - 1] = -300.0;
  EXPECT_NEAR(theta.prior(u).residual[theta.size() - 1], -300.0, 1e-9) << "a gyro bias has no sign";
  const double h = 1e-5;
  for (const double share : {0.7, 0.05, 1e-6})
    EXPECT_NEAR((at(share * std::exp(h)).first - at(share * std::exp(-h)).first) / (2 * h), at(share).second,
                1e-8);
}

// What the motors do in the first moments, and just after a gap, was commanded before: it is not in the log.
// Such rows once pulled the motor constants of a drawn vehicle four standard deviations away.
TEST(FlightRefine, RowsWhoseCommandsAreUnknownAreLeftOut) {
  Vehicle vehicle = feasible();
  vehicle.parameters["dead_time"] = {0.012, {}};
  SimulationOptions options;
  options.duration = 4.0;
  FlightLog log = flights(vehicle, options).front();
  log.windows = {{0.0, 1.0}, {1.5, 9.0}};
  const double resumes = log.t[500] + 0.5;  // half a second is missing
  for (std::size_t i = 500; i < log.rows(); ++i) log.t[i] += 0.5;
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), {&log, 1});
  ASSERT_EQ(record.arcs.size(), 3U);
  EXPECT_NEAR(record.arcs[0].t.front(), 0.062, 0.006);
  EXPECT_NEAR(record.arcs[1].t.front(), 1.5, 0.006);  // a window: what was commanded before it is in the log
  EXPECT_NEAR(record.arcs[2].t.front(), resumes + 0.062, 0.006);
}

}  // namespace
}  // namespace ident
