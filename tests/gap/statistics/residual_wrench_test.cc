// Where a gap lies: the residual wrench of flights whose model is right, or lacks one thing.
#include "ident/gap/statistics/residual_wrench.h"

#include <gtest/gtest.h>

#include "ident/gap/views/gap_sections.h"
#include "support/diagnosed.h"

namespace ident {
namespace {

nlohmann::ordered_json channels_of(const Vehicle& truth, const Vehicle& model) {
  const std::vector<FlightLog> logs{testing::flight_of(truth, 4)};
  return diagnose_gap(model, logs).result.extra["where"]["channels"];
}

// The smoother draws the rotors' accelerations towards zero as far as their noise allows; measured against
// what is left of noise then, a hundredth of a rad/s^2 was most of the gap.
TEST(ResidualWrench, AForceThatIsMissingIsNotLookedForInTheRotors) {
  const Vehicle model = testing::published_vehicle();
  Vehicle truth = model;
  truth.parameters["rotor_drag.kd"] = {6e-5, {}};
  double rotors = 0, all = 0;
  for (const auto& c : channels_of(truth, model)) {
    all += c["share"].get<double>();
    if (c["name"].get<std::string>().starts_with("rotor")) rotors += c["share"].get<double>();
  }
  EXPECT_GT(all, 0.99);
  EXPECT_LT(rotors, 0.01);
}

}  // namespace
}  // namespace ident
