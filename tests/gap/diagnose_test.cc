// The diagnosis end to end on simulated flight: the cause that was withheld, and none where nothing was.
#include "ident/gap/diagnose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ident/core/error.h"
#include "support/diagnosed.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;

using namespace testing;  // flights of support/, not GoogleTest's

// As a simulator's file states it: without a deviation.
TEST(Diagnosis, AWrongSizeOfAStatedEffectIsNamed) {
  Vehicle model = published_vehicle();
  model.parameters["rotor_drag.kd"] = {9e-5, {}};
  Vehicle truth = model;
  truth.parameters["rotor_drag.kd"].value = 3e-5;
  const std::vector<FlightLog> logs{flight_of(truth, 9)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"parameter:rotor_drag.kd"}))
      << found.result.extra["verdict"];
  EXPECT_NEAR(found.adopted.parameters.at("rotor_drag.kd").value, 3e-5, 3e-6);
  const std::vector<FlightLog> right{flight_of(model, 10)};
  EXPECT_EQ(diagnose_gap(model, right).result.extra["verdict"]["status"], "none");
}

TEST(Diagnosis, PrintedSignsOfPhangAreFoundAsGyroscopicAndRightOnesLeaveNothing) {
  const Vehicle truth = published_vehicle();
  Vehicle printed = truth;
  printed.signs = Signs::as_published;
  const FlightLog log = flight_of(truth, 1);
  const auto wrong = verdict_of(printed, log);
  EXPECT_EQ(wrong["status"], "identified");
  EXPECT_EQ(wrong["effects"], nlohmann::ordered_json({"gyroscopic"}));
  EXPECT_EQ(verdict_of(truth, log)["status"], "none");
}

TEST(Diagnosis, WithheldRotorDragIsNamedAndWithoutItInTheCatalogueNothingElseIs) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {3e-5, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 2)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"rotor_drag"}));
  EXPECT_NEAR(found.adopted.parameters.at("rotor_drag.kd").value, 3e-5, 3e-6);
  GapOptions options;
  options.exclude = {"rotor_drag"};
  const auto v = diagnose_gap(model, logs, options).result.extra["verdict"];
  EXPECT_EQ(v["status"], "unknown") << v;
}

TEST(Diagnosis, LongMotorDelayIsFoundThoughItIsFarFromLinear) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["motor_delay.tau"] = {0.02, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 3)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"motor_delay"}));
  EXPECT_NEAR(found.adopted.parameters.at("motor_delay.tau").value, 0.02, 1e-3);
}

// As a refinement leaves it: the thrust of each rotor is stated, with what it scatters by from flight to
// flight.
TEST(Diagnosis, ARotorThatLostMoreThanItsStatedThrustScattersIsAWeakRotor) {
  Vehicle truth = published_vehicle();
  Vehicle model = truth;
  for (const char* rotor : {"1", "2", "3", "4"})
    model.parameters[std::string("rotor_mismatch.ratio@") + rotor] = {1.0, 0.035};
  truth.parameters["rotor_mismatch.ratio@2"] = {0.75, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 4)};
  const Diagnosis found = diagnose_gap(model, logs);
  const auto& verdict = found.result.extra["verdict"];
  EXPECT_EQ(verdict["effects"], nlohmann::ordered_json({"rotor_mismatch"})) << verdict["sentence"];
  EXPECT_NEAR(found.adopted.value("rotor_mismatch.ratio@2") / found.adopted.value("rotor_mismatch.ratio@3"),
              0.75, 0.02);
  EXPECT_EQ(verdict_of(model, flight_of(published_vehicle(), 4))["status"], "none");
}

// A second diagnosis after a first one has one rotor in its model, and then another one wears.
TEST(Diagnosis, ARotorWhoseThrustIsStatedSaysNothingOfTheOthers) {
  Vehicle truth = published_vehicle();
  truth.parameters["rotor_mismatch.ratio@1"] = {0.9, {}};
  truth.parameters["rotor_tilt.x@2"] = {0.02, {}};
  const Vehicle model = truth;
  truth.parameters["rotor_mismatch.ratio@3"] = {0.85, {}};
  const Diagnosis found = diagnose_gap(model, std::vector<FlightLog>{flight_of(truth, 7)});
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"rotor_mismatch"}))
      << found.result.extra["verdict"];
  EXPECT_NEAR(found.adopted.value("rotor_mismatch.ratio@3"), 0.85, 0.02);
  EXPECT_EQ(verdict_of(model, flight_of(model, 7))["status"], "none");
}

// A turned sensor mimics a biased accelerometer for most of a flight, but not all: a regression on what the
// sensors show finds the rest.
TEST(Diagnosis, ALookAlikeIsNotNamedWhenTheCauseItselfMayNotBe) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["imu_bias.ax"] = {0.3, {}};
  truth.parameters["imu_bias.az"] = {0.2, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 5)};
  GapOptions options;
  EXPECT_EQ(diagnose_gap(model, logs, options).result.extra["verdict"]["effects"],
            nlohmann::ordered_json({"imu_bias"}));
  options.exclude = {"imu_bias"};
  const auto verdict = diagnose_gap(model, logs, options).result.extra["verdict"];
  EXPECT_EQ(verdict["status"], "unknown") << verdict["sentence"];
}

// Stated ten times too fast, and with confidence, a motor bends every other constant before it moves itself.
TEST(Diagnosis, AMotorStatedNearlyInstantIsTheCauseItself) {
  Vehicle model = published_vehicle();
  const FlightLog log = flight_of(model, 6);
  const double truth = model.value("omega_m");
  model.parameters.at("omega_m") = {10 * truth, 0.5 * truth};
  known_to(0.1, {"zeta_m", "km", "kT", "kQ", "Jxx", "Jyy", "Jzz"}, model);
  const std::vector<FlightLog> logs{log};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"parameter:omega_m"}))
      << found.result.extra["verdict"];
  EXPECT_NEAR(found.adopted.parameters.at("omega_m").value, truth, 0.1 * truth);
}

// Held at its wrong value by what was stated of it, even a little, it would leave work to other causes.
TEST(Diagnosis, ARotorInertiaStatedAsNoneIsNamedAloneAndNotPulledBack) {
  Vehicle model = published_vehicle();
  known_to(0.01, {"omega_m", "zeta_m", "Jxx", "Jyy", "Jzz"}, model);
  known_to(0.003, {"km", "kT", "kQ"}, model);
  Vehicle truth = model;
  truth.parameters["Jp"] = {7e-6, {}};
  model.parameters["Jp"] = {0.0, 1e-9};
  const std::vector<FlightLog> logs{flight_of(truth, 11)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"parameter:Jp"}))
      << found.result.extra["verdict"];
  const Known& Jp = found.adopted.parameters.at("Jp");
  EXPECT_NEAR(Jp.value, 7e-6, 3 * *Jp.std);
}

// Damping stated wrongly and with confidence, beside a loose omega_m that the same fit may move.
TEST(Diagnosis, AWronglyStatedDampingIsFoundAndWithoutItInTheCatalogueSaidToBeContradicted) {
  Vehicle model = published_vehicle();
  const FlightLog log = flight_of(model, 8);
  const double truth = model.value("zeta_m");
  model.parameters.at("zeta_m") = {0.6 * truth, 0.012 * truth};
  known_to(0.1, {"omega_m"}, model);
  known_to(0.05, {"km", "kT", "kQ", "Jxx", "Jyy", "Jzz"}, model);
  const std::vector<FlightLog> logs{log};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"parameter:zeta_m"}))
      << found.result.extra["verdict"];
  EXPECT_NEAR(found.adopted.parameters.at("zeta_m").value, truth, 0.05 * truth);
  GapOptions options;
  options.exclude = {"parameter:zeta_m"};
  const auto without = diagnose_gap(model, logs, options).result.extra["verdict"];
  EXPECT_EQ(without["status"], "unknown") << without;
}

// From the fit without it the first step ends beyond what any battery does.
TEST(Diagnosis, AStrongBatterySagIsFoundThoughItsFirstStepIsBeyondPhysics) {
  Vehicle model = published_vehicle();
  known_to(0.1, {"omega_m", "zeta_m"}, model);
  known_to(0.05, {"km", "kT", "kQ", "Jxx", "Jyy", "Jzz"}, model);
  Vehicle truth = model;
  truth.parameters["battery_sag.rate"] = {0.008, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 9)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"battery_sag"}))
      << found.result.extra["verdict"];
}

// A sensor half a metre off a vehicle of half that size is none: something else moves it so, which is
// unknown.
TEST(Diagnosis, ACauseOfASizeThatNoSuchVehicleHasIsNotNamed) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["imu_lever_arm.x"] = {0.5, {}};
  const auto verdict = verdict_of(model, flight_of(truth, 11));
  EXPECT_EQ(verdict["status"], "unknown") << verdict;
  EXPECT_TRUE(verdict["effects"].empty()) << verdict;
}

// How the sensor is mounted does not use up the causes that were asked for.
TEST(Diagnosis, HowTheSensorIsMountedComesOnTopOfTheCausesAskedFor) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {3e-5, {}};
  truth.parameters["imu_lever_arm.x"] = {0.03, {}};
  truth.parameters["imu_misalignment.y"] = {0.03, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 10)};
  GapOptions options;
  options.most_causes = 1;
  const auto verdict = diagnose_gap(model, logs, options).result.extra["verdict"];
  Names effects = verdict["effects"];
  std::ranges::sort(effects);
  EXPECT_EQ(effects, (Names{"imu_lever_arm", "imu_misalignment", "rotor_drag"})) << verdict;
}

// With a weak rotor missing in the model a payload is a shifted centre of gravity at first sight; with both
// in it the weights speak for the payload.
TEST(Diagnosis, WhatWasFoundFirstIsExchangedWhereTheRestSpeaksAgainstIt) {
  Vehicle model = published_vehicle();
  for (const char* name : {"kQ", "km"}) model.parameters.at(name).std = 0.03 * model.value(name);
  for (const char* name : {"Jxx", "Jyy", "Jzz"}) model.parameters.at(name).std = 0.05 * model.value(name);
  model.parameters.at("kT").std = 0.1 * model.value("kT");
  model.parameters.at("m").std = 0.02 * model.value("m");
  Vehicle truth = model;
  truth.parameters["rotor_mismatch.ratio@2"] = {0.95, {}};
  truth.parameters["payload.m"] = {0.04, {}};
  truth.parameters["payload.x"] = {0.03, {}};
  truth.parameters["payload.y"] = {0.01, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 2)};
  const Diagnosis found = diagnose_gap(model, logs);
  Names effects = found.result.extra["verdict"]["effects"];
  std::ranges::sort(effects);
  EXPECT_EQ(effects, (Names{"payload", "rotor_mismatch"})) << found.result.extra["verdict"];
}

TEST(Diagnosis, ACauseThatIsNoneCannotBeLeftOut) {
  GapOptions options;
  options.exclude = {"rotor_darg"};
  const std::vector<FlightLog> logs{flight_of(published_vehicle(), 1)};
  EXPECT_THROW(diagnose_gap(published_vehicle(), logs, options), UsageError);
}

// The slant angle that was fitted is that of the rotors that are written.
TEST(Diagnosis, TheModelWithTheCauseHasTheSlantThatWasFitted) {
  Vehicle model = published_vehicle();
  model.parameters["alpha"].value += 0.02, model.parameters["alpha"].std = 0.02;
  for (Rotor& rotor : model.rotors) rotor.a_B = axis_at(rotor, slant_angle(model));
  const std::vector<FlightLog> logs{flight_of(published_vehicle(), 5)};
  const Vehicle adopted = diagnose_gap(model, logs).adopted;
  EXPECT_NEAR(slant_angle(adopted), slant_angle(published_vehicle()), 0.005);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_LT((adopted.rotors[n].a_B - axis_at(adopted.rotors[n], slant_angle(adopted))).norm(), 1e-12);
}

// Wind acts through a drag that the model lacks: it is tried once that was found, and stands among the causes
// tried, as each of two does with what it closes alone.
TEST(Diagnosis, EveryCauseNamedStandsAmongThoseTriedWithWhatItClosesAlone) {
  Vehicle truth = published_vehicle();
  const Vehicle model = truth;
  truth.parameters["rotor_drag.kd"] = {6e-5, {}};
  truth.parameters["wind.north"] = {6.0, {}};
  truth.parameters["wind.east"] = {-4.0, {}};
  GapOptions options;
  options.exclude = {"battery_sag"};
  const auto found = diagnose_gap(model, std::vector<FlightLog>{flight_of(truth, 12)}, options).result.extra;
  EXPECT_EQ(found["verdict"]["effects"], nlohmann::ordered_json({"wind"})) << found["verdict"]["sentence"];
  const auto& tried = found["candidates"];
  const auto entry = [&](const std::string& name) {
    return *std::ranges::find_if(tried, [&](const auto& c) { return c["effect"] == name; });
  };
  ASSERT_NE(std::ranges::find_if(tried, [](const auto& c) { return c["effect"] == "wind"; }), tried.end());
  EXPECT_GT(entry("wind")["probability"], 0.9);
  EXPECT_GT(entry("wind")["evidence"], 100.0);
  EXPECT_NEAR(entry("wind")["parameters"]["wind.north"]["value"], 6.0, 1.0);
  EXPECT_TRUE(entry("wind")["detection_limit"]["wind.north"].is_number());
  EXPECT_GT(entry("wind")["closed"], 0.9);
  EXPECT_LT(entry("rotor_drag")["closed"], 0.9);  // drag in still air
  EXPECT_TRUE(entry("parasitic_drag")["closed"].is_null());
  const auto& left = found["not_tried"];
  const auto why = std::ranges::find_if(left, [](const auto& c) { return c["effect"] == "battery_sag"; });
  ASSERT_NE(why, left.end());
  EXPECT_EQ((*why)["why"], "left out as asked");
  EXPECT_TRUE(std::ranges::none_of(left, [](const auto& c) { return c["effect"] == "wind"; }));
}

}  // namespace
}  // namespace ident
