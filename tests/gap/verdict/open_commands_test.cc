// Diagnoses of logs whose controller went on between their rows.
#include "ident/gap/verdict/open_commands.h"

#include <gtest/gtest.h>

#include "support/diagnosed.h"
#include "support/known_quad.h"
#include "support/thinned.h"

namespace ident {
namespace {

// By a controller at 1 kHz that hears the noise of its gyro, logged at 100 Hz.
FlightLog flown(const Vehicle& vehicle, std::uint64_t seed) {
  SimulationOptions options;
  options.duration = 30, options.rate = 1000, options.seed = seed, options.by_gyro = true;
  options.signals.rotor_speeds = 0;
  return testing::thinned(simulate_flight(vehicle, options).log, 10);
}

// By a bench that knows each constant well.
Vehicle stated() {
  Vehicle vehicle = testing::quad(0.0);
  for (auto& [name, known] : vehicle.parameters) known.std = 0.02 * known.value;
  vehicle.parameters["m"].std = 0.003 * vehicle.value("m");
  vehicle.parameters.erase("dead_time");
  return vehicle;
}

TEST(OpenCommands, AreNoGapOfTheVehicle) {
  const std::vector<FlightLog> logs{flown(testing::quad(0.0), 1)};
  const auto [result, adopted, verdict, gap] = diagnose_gap(stated(), logs);
  EXPECT_EQ(verdict.status, "none") << result.verdict;
  EXPECT_FALSE(adopted.has("dead_time"));
  EXPECT_EQ(adopted.value("omega_m"), stated().value("omega_m"));
  EXPECT_TRUE(result.has_warning("commands_between_rows"));
  const Parameter& omega_m = *result.find("omega_m");
  EXPECT_FALSE(omega_m.identifiable);
  EXPECT_DOUBLE_EQ(*omega_m.prior_std, *stated().parameters.at("omega_m").std);  // and not what was left open
  EXPECT_FALSE(result.has_warning("negative_dead_time"));  // by half the time between commands, or less
}

TEST(OpenCommands, HideNoCauseThatIsNotOfMotors) {
  Vehicle truth = testing::quad(0.0);
  truth.parameters["cg_offset.x"].value = 0.003;
  const std::vector<FlightLog> logs{flown(truth, 2)};
  const Result result = diagnose_gap(stated(), logs).result;
  EXPECT_EQ(result.extra["verdict"]["effects"], nlohmann::ordered_json({"cg_offset"})) << result.verdict;
}

TEST(OpenCommands, LeaveMotorsOpen) {
  Vehicle vehicle = stated();
  vehicle.correlation = {{"kT", "km", "kQ"}, Eigen::Matrix3d::Identity()};
  vehicle.correlation.matrix(0, 1) = vehicle.correlation.matrix(1, 0) = -0.9;
  const Vehicle open = with_open_motors(vehicle, 0.01);
  EXPECT_DOUBLE_EQ(*open.parameters.at("omega_m").std, 0.3 * vehicle.value("omega_m"));
  EXPECT_DOUBLE_EQ(*open.parameters.at("dead_time").std, 0.005);
  EXPECT_EQ(open.parameters.at("kT").std, vehicle.parameters.at("kT").std);
  EXPECT_DOUBLE_EQ(open.correlation.of("kT", "km"), -0.9);
  EXPECT_DOUBLE_EQ(open.correlation.of("kT", "kQ"), 0.0);
  vehicle.parameters["omega_m"].std = 0.5 * vehicle.value("omega_m");  // known no better
  EXPECT_DOUBLE_EQ(*with_open_motors(vehicle, 0.01).parameters.at("omega_m").std,
                   0.5 * vehicle.value("omega_m"));
  vehicle.parameters["zeta_m"].std.reset(), vehicle.parameters["kQ"].std = 0.0;
  vehicle.parameters["dead_time"].std = 0.0;
  EXPECT_FALSE(with_open_motors(vehicle, 0.01).parameters.at("zeta_m").std.has_value());  // free already
  EXPECT_EQ(*with_open_motors(vehicle, 0.01).parameters.at("kQ").std, 0.0);               // held
  EXPECT_EQ(*with_open_motors(vehicle, 0.01).parameters.at("dead_time").std, 0.0);
  vehicle.parameters.erase("Jp");
  EXPECT_FALSE(with_open_motors(vehicle, 0.01).has("Jp"));  // what nobody states is held as it is
}

TEST(OpenCommands, PassForMotorsAndTakeNothingBackOfOtherCauses) {
  const auto judged = [](std::vector<std::string> effects) {
    return with_open_commands({.status = "identified", .sentence = "Named.", .effects = std::move(effects)},
                              {}, 0.01, [](const Judged&) { return "Of what is left."; });
  };
  EXPECT_EQ(judged({"rotor_drag"}).status, "identified");
  EXPECT_NE(judged({"rotor_drag"}).sentence.find("were left open"), std::string::npos);
  for (const char* cause : {"motor_asymmetry", "motor_delay", "parameter:omega_m", "parameter:Jp"}) {
    const Judged verdict = judged({"rotor_drag", cause});
    EXPECT_EQ(verdict.status, "partly") << cause;
    EXPECT_EQ(verdict.effects, std::vector<std::string>{"rotor_drag"});
    EXPECT_EQ(verdict.confused_with, std::vector<std::string>{cause});
    EXPECT_NE(verdict.sentence.find("100 a second"), std::string::npos) << verdict.sentence;
    EXPECT_EQ(judged({cause}).status, "unknown") << cause;
  }
}

// Aliased commands ask for a thrust curve of a tenth; of 0.4 it is one.
TEST(OpenCommands, PassForAThrustCurveOfTheirSize) {
  const auto named = [](double c, double offset) {
    const std::vector<Parameter> found{{.name = "thrust_curve.c", .value = c, .std = 0.01},
                                       {.name = "thrust_curve.offset", .value = offset, .std = 0.02}};
    return !with_open_commands({.status = "identified", .sentence = "Named.", .effects = {"thrust_curve"}},
                               found, 0.02, [](const Judged&) { return "Of what is left."; })
                .effects.empty();
  };
  EXPECT_FALSE(named(-0.05, -0.13));
  EXPECT_TRUE(named(-0.44, 0.15));
  EXPECT_TRUE(named(0.0, -0.5));
}

}  // namespace
}  // namespace ident
