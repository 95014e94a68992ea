// The vehicle of a campaign: what was found over what was stated, and what was corrected since.
#include "ident/io/campaign/campaign.h"

#include <gtest/gtest.h>

#include "support/run_program.h"

namespace ident {
namespace {

Campaign campaign(const std::string& stated, const std::string& found) {
  const std::string folder = test_folder();
  write_text(folder, "ident.yaml", "vehicle: quad.yaml\nparameters: found.yaml\n");
  write_text(folder, "quad.yaml", "layout: x\narm: 0.17\nmass: " + stated + "\nparameters:\n  omega_m: 20\n");
  write_text(folder, "found.yaml", "mass: " + found + "\nparameters:\n  omega_m: {value: 31, std: 0.1}\n");
  return read_campaign(folder);
}

TEST(Campaign, WhatWasFoundTakesThePlaceOfWhatWasStated) {
  const Vehicle vehicle =
      campaign_vehicle(campaign("{value: 0.5, std: 0.001}", "{value: 0.5021, std: 0.0006}"));
  EXPECT_EQ(vehicle.value("m"), 0.5021);
  EXPECT_EQ(vehicle.value("omega_m"), 31.0);
  EXPECT_TRUE(vehicle.warnings.empty()) << vehicle.warnings[0].message;
}

// A mass that was weighed again does not take the place of the one that an older refinement stored.
TEST(Campaign, WhatIsStatedOtherwiseSinceIsNamed) {
  const Vehicle vehicle =
      campaign_vehicle(campaign("{value: 0.52, std: 0.001}", "{value: 0.5021, std: 0.0006}"));
  ASSERT_EQ(vehicle.warnings.size(), 1U);
  EXPECT_EQ(vehicle.warnings[0].code, "stated_otherwise");
  for (const char* part :
       {"found.yaml: m = 0.50210", "takes the place of 0.5200", "15 standard deviations off"})
    EXPECT_NE(vehicle.warnings[0].message.find(part), std::string::npos) << vehicle.warnings[0].message;
}

}  // namespace
}  // namespace ident
