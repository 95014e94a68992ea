// The diagnosis end to end where masses moved: a payload, a centre of gravity, and which of the two.
#include <gtest/gtest.h>

#include <algorithm>

#include "ident/gap/diagnose.h"
#include "support/diagnosed.h"

namespace ident {
namespace {

using Names = std::vector<std::string>;

using namespace testing;  // flights of support/, not GoogleTest's

// A heavy payload shows its inertia only where it acts: linearised at zero it is a shifted centre of gravity,
// and then products of inertia.
TEST(Diagnosis, AHeavyPayloadIsOneCauseNotTwo) {
  Vehicle model = published_vehicle();
  for (const char* name : {"kT", "kQ", "km", "Jxx", "Jyy", "Jzz"})
    model.parameters.at(name).std = 0.05 * model.value(name);
  model.parameters.at("m").std = 0.03 * model.value("m");
  Vehicle truth = model;
  const double m = 0.07 * model.value("m");
  truth.parameters["payload.m"] = {m, {}};
  truth.parameters["payload.x"] = {0.02, {}};
  truth.parameters["payload.y"] = {0.05, {}};
  truth.parameters["payload.z"] = {-0.04, {}};
  const std::vector<FlightLog> logs{flight_of(truth, 7)};
  const Diagnosis found = diagnose_gap(model, logs);
  EXPECT_EQ(found.result.extra["verdict"]["effects"], nlohmann::ordered_json({"payload"}))
      << found.result.extra["verdict"];
  EXPECT_NEAR(found.adopted.parameters.at("payload.m").value, m, 0.1 * m);
  EXPECT_NEAR(found.adopted.parameters.at("payload.y").value, 0.05, 0.005);
}

// Linearised at none, a light payload beside a weak rotor is a shifted centre of gravity; what little that
// leaves makes the search look at both where they act.
TEST(Diagnosis, ALightPayloadBesideAWeakRotorIsNoShiftOfTheCentreOfGravity) {
  Vehicle model = published_vehicle();
  known_to(0.05, {"kT", "kQ", "km", "Jxx", "Jyy", "Jzz"}, model);
  model.parameters.at("m").std = 0.03 * model.value("m");
  Vehicle truth = model;
  truth.parameters["rotor_mismatch.ratio@3"] = {0.83, {}};
  truth.parameters["payload.m"] = {0.012, {}};
  truth.parameters["payload.x"] = {0.02, {}};
  truth.parameters["payload.y"] = {0.037, {}};
  truth.parameters["payload.z"] = {0.057, {}};
  const auto verdict = verdict_of(model, flight_of(truth, 4));
  Names effects = verdict["effects"];
  std::ranges::sort(effects);
  EXPECT_EQ(effects, (Names{"payload", "rotor_mismatch"})) << verdict;
}

// A payload too light to be weighed shows as a shifted centre of gravity only: both are named. Where the mass
// is known well it is the payload.
TEST(Diagnosis, CentreOfGravityAndPayloadAreToldApartByTheMassOnly) {
  Vehicle model = published_vehicle(), truth = model;
  truth.parameters["payload.m"] = {0.002, {}};
  truth.parameters["payload.x"] = {0.1, {}};
  const FlightLog log = flight_of(truth, 4);
  const auto first = verdict_of(model, log);
  EXPECT_EQ(first["effects"], nlohmann::ordered_json({"payload"})) << first;
  model.parameters.at("m").std = 0.01;
  const auto verdict = verdict_of(model, log);
  std::vector<std::string> named = verdict["effects"];
  for (const auto& other : verdict["confused_with"]) named.push_back(other);
  std::ranges::sort(named);
  EXPECT_EQ(named, (std::vector<std::string>{"cg_offset", "payload"})) << verdict["sentence"];
}

}  // namespace
}  // namespace ident
