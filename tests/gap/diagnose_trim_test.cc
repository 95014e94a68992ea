// The diagnosis of flights without rates and attitude.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/gap/diagnose.h"
#include "support/path_only.h"
#include "support/real_data.h"

namespace ident {
namespace {

using testing::path_only;
using testing::with_ratios;
using Json = nlohmann::ordered_json;

// A flight of `truth` against equal rotors that are known to that share.
Diagnosis of_flight(const Vehicle& truth, double known = 0.02) {
  const Vehicle model = with_ratios(testing::upright(), {1, 1, 1, 1}, known);
  const std::vector<FlightLog> logs{path_only(truth, 5)};
  return diagnose_gap(model, logs);
}

const Json* candidate(const Diagnosis& found, const std::string& name) {
  for (const Json& c : found.result.extra["candidates"])
    if (c["effect"] == name) return &c;
  return nullptr;
}

TEST(DiagnoseTrim, NothingIsFoundWhereNothingIs) {
  const Diagnosis found = of_flight(testing::upright());
  EXPECT_EQ(found.result.extra["verdict"]["status"], "none");
  EXPECT_TRUE(found.result.has_warning("no_turning"));
  EXPECT_FALSE(found.result.has_warning("rotors_unknown"));
  EXPECT_TRUE(found.result.extra["gap"]["closed"].is_null());
}

TEST(DiagnoseTrim, AWeakRotorIsNamedAboveTheSizeThatIsSaidToBeSeen) {
  const Vehicle whole = testing::upright();
  const Diagnosis found = of_flight(with_ratios(whole, {1, 1, 0.8, 1}));
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_EQ(verdict["status"], "ambiguous") << verdict;
  EXPECT_EQ(verdict["effects"], Json{"rotor_mismatch"}) << verdict;
  // A load on that rotor presses as it fails to lift: 0.05 of the weight of four equal rotors.
  EXPECT_EQ(verdict["confused_with"], Json{"payload"}) << verdict;
  const double load = (*candidate(found, "payload"))["parameters"]["payload.m"]["value"];
  EXPECT_NEAR(load, 0.05 * whole.value("m"), 0.015 * whole.value("m"));
  const Json& parameters = (*candidate(found, "rotor_mismatch"))["parameters"];
  EXPECT_EQ(parameters["rotor_mismatch.rotor"]["value"], 3);
  EXPECT_NEAR(parameters["rotor_mismatch.ratio"]["value"].get<double>(), 0.8, 0.06);
  const double limit = (*candidate(found, "rotor_mismatch"))["detection_limit"]["rotor_mismatch.ratio"];
  EXPECT_LT(limit, 0.2);
  const Diagnosis weak = of_flight(with_ratios(whole, {1, 1, 1 - 0.3 * limit, 1}));
  EXPECT_EQ(weak.result.extra["verdict"]["status"], "none");
}

TEST(DiagnoseTrim, NoLoadMakesARotorStronger) {
  const Diagnosis found = of_flight(with_ratios(testing::upright(), {1, 1, 1.25, 1}));
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_EQ(verdict["effects"], Json{"rotor_mismatch"}) << verdict;
  EXPECT_FALSE(std::ranges::count(verdict["confused_with"], "payload")) << verdict;
}

TEST(DiagnoseTrim, AShiftedCentreOfGravityIsNoWeakRotor) {
  Vehicle truth = testing::upright();
  truth.parameters["cg_offset.x"] = {0.02, {}}, truth.parameters["cg_offset.y"] = {-0.015, {}};
  const Diagnosis found = of_flight(truth);
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_NE(verdict["status"], "none");
  ASSERT_FALSE(verdict["effects"].empty()) << verdict;
  EXPECT_EQ(verdict["effects"][0], "cg_offset") << verdict;
}

TEST(DiagnoseTrim, ALoadIsNotNamedAlone) {
  Vehicle truth = testing::upright();
  truth.parameters["payload.m"] = {0.1, {}}, truth.parameters["payload.x"] = {0.15, {}};
  const Diagnosis found = of_flight(truth);
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_NE(verdict["status"], "none");
  EXPECT_NE(verdict["status"], "identified") << verdict;
  EXPECT_TRUE(std::ranges::count(verdict["confused_with"], "payload")) << verdict;
}

TEST(DiagnoseTrim, AWrongThrustOnTheWholeIsNotAscribedToOneOfItsConstants) {
  Vehicle model = with_ratios(testing::upright(), {1, 1, 1, 1}, 0.02);
  for (const char* name : {"kT", "km"}) model.parameters.at(name).std = 0.03 * model.value(name);
  Vehicle truth = testing::upright();
  truth.parameters.at("kT").value *= 0.7;
  const Diagnosis found = diagnose_gap(model, std::vector<FlightLog>{path_only(truth, 5)});
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_EQ(verdict["status"], "unknown");
  EXPECT_EQ(verdict["confused_with"], (Json{"parameter:kT", "parameter:km"})) << verdict;
}

TEST(DiagnoseTrim, ASaggingBatteryDriftsAndIsFound) {
  Vehicle model = with_ratios(testing::upright(), {1, 1, 1, 1}, 0.02);
  model.battery_voltage = 12.0;
  for (const char* name : {"kT", "km"}) model.parameters.at(name).std = 0.03 * model.value(name);
  Vehicle truth = testing::upright();
  truth.battery_voltage = 12.0, truth.parameters["battery_sag.n"] = {0.7, {}};
  const FlightLog log = path_only(truth, 5, {.seconds = 60.0, .battery = true});
  const Diagnosis found = diagnose_gap(model, std::vector<FlightLog>{log});
  EXPECT_EQ(found.result.extra["verdict"]["effects"], Json{"battery_sag"});
  EXPECT_NEAR((*candidate(found, "battery_sag"))["parameters"]["battery_sag.n"]["value"].get<double>(), 0.7,
              0.15);
}

TEST(DiagnoseTrim, WhereNobodyKnowsTheRotorsThatIsSaid) {
  const std::vector<FlightLog> logs{path_only(with_ratios(testing::upright(), {1, 1, 0.9, 1}), 5)};
  const Diagnosis found = diagnose_gap(testing::upright(), logs);
  EXPECT_EQ(found.result.extra["verdict"]["status"], "none");
  EXPECT_TRUE(found.result.has_warning("rotors_unknown"));
  EXPECT_GT((*candidate(found, "rotor_mismatch"))["detection_limit"]["rotor_mismatch.ratio"].get<double>(),
            0.2);
}

// The vehicle as two normal flights show it.
Vehicle crazypad_as_it_flies(const std::string& folder) {
  Vehicle vehicle = crazypad_crazyflie();
  std::vector<FlightLog> normal;
  for (const char* name : {"00", "02"})
    normal.push_back(crazypad_flight(folder, std::string("m_normal_flight__E9_log") + name, vehicle));
  for (const Parameter& p : refine_flight(vehicle, normal).parameters)
    vehicle.parameters[p.name] = {p.value, p.std};
  return vehicle;
}

// Normal flights, and one with a blade that is 1 mm shorter, which lies within what normal flights differ by.
TEST(DiagnoseTrim, AMillimetreOfABladeIsNotToldFromNormalFlights) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = crazypad_as_it_flies(folder);
  for (const char* name : {"m_normal_flight__E9_log03", "m_cut_propeller_M3_1mm__E9_log03"}) {
    const std::vector<FlightLog> logs{crazypad_flight(folder, name, vehicle)};
    const Diagnosis found = diagnose_gap(vehicle, logs);
    EXPECT_EQ(found.result.extra["verdict"]["status"], "none") << name << found.result.extra["verdict"];
    const double limit = (*candidate(found, "rotor_mismatch"))["detection_limit"]["rotor_mismatch.ratio"];
    EXPECT_GT(limit, 0.08);
    EXPECT_LT(limit, 0.25);
  }
}

// The rotors of that flight are as of a third that is weak. What was done to it is a weight, beside that
// rotor.
TEST(DiagnoseTrim, AWeightBesideARotorIsNoWeakRotorAlone) {
  IDENT_NEEDS_REAL_DATA(folder);
  const Vehicle vehicle = crazypad_as_it_flies(folder);
  const std::vector<FlightLog> logs{crazypad_flight(folder, "m_weight_W3_near_M3__E9", vehicle)};
  const Diagnosis found = diagnose_gap(vehicle, logs);
  const Json& verdict = found.result.extra["verdict"];
  EXPECT_NE(verdict["status"], "identified") << verdict;
  EXPECT_TRUE(std::ranges::count(verdict["confused_with"], "payload")) << verdict;
  EXPECT_LE((*candidate(found, "rotor_mismatch"))["probability"].get<double>(), 0.5);
}

}  // namespace
}  // namespace ident
