// What hover is not trusted with: held for an estimate, and left to its own deviation for a diagnosis.
#include "ident/flight/fit/hover_priors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/known_quad.h"

namespace ident {
namespace {

std::vector<FreeConstant> constants_of_a_quad() {
  Vehicle vehicle = testing::known(testing::quad());
  vehicle.parameters.at("Jp").std.reset();
  return free_constants(vehicle, parameter_vector(vehicle), {"Jp"});
}

const FreeConstant& named(const std::vector<FreeConstant>& all, const std::string& name) {
  return *std::ranges::find(all, name, &FreeConstant::name);
}

TEST(Hover, HoldsWhatNeedsMotion) {
  const std::vector<FreeConstant> before = constants_of_a_quad();
  std::vector<FreeConstant> held = before;
  const std::vector<std::string> names = hold_for_hover(held);
  EXPECT_EQ(std::ranges::count(names, "Jzz"), 1);
  EXPECT_EQ(std::ranges::count(names, "kT"), 0);
  EXPECT_LT(*named(held, "Jzz").prior_std, 0.01 * *named(before, "Jzz").prior_std);
  EXPECT_EQ(*named(held, "kT").prior_std, *named(before, "kT").prior_std);
}

TEST(Hover, ADiagnosisKeepsStatedConstantsFreeWithinTheirPrior) {
  const std::vector<FreeConstant> before = constants_of_a_quad();
  std::vector<FreeConstant> held = before;
  EXPECT_EQ(std::ranges::count(hold_for_hover(held, Held::unstated), "Jzz"), 1)
      << "not to be learnt from hover";
  EXPECT_EQ(*named(held, "Jzz").prior_std, *named(before, "Jzz").prior_std);
  ASSERT_FALSE(named(before, "Jp").prior_std);
  EXPECT_TRUE(named(held, "Jp").prior_std) << "and what nobody stated stays where it is";
}

}  // namespace
}  // namespace ident
