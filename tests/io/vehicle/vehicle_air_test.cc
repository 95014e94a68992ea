// How much the air moves: of a vehicle file, of a campaign, and of both.
#include <gtest/gtest.h>

#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/run_program.h"

namespace ident {
namespace {

const std::string kQuad = "layout: x\narm: 0.17\nmass: 0.5\n";

std::optional<AirLevel> air_of(const std::string& campaign, const std::string& vehicle) {
  const std::string folder = test_folder();
  write_text(folder, "ident.yaml", "vehicle: quad.yaml\n" + campaign);
  write_text(folder, "quad.yaml", kQuad + vehicle);
  return campaign_vehicle(read_campaign(folder)).air;
}

TEST(VehicleAir, IsReadAndWrittenOnlyWhereItIsStated) {
  const std::string silent = write_text(test_folder(), "silent.yaml", kQuad);
  EXPECT_FALSE(read_vehicle(silent).air);
  EXPECT_EQ(vehicle_to_yaml(read_vehicle(silent)).find("air:"), std::string::npos);
  const std::string stated = write_text(test_folder(), "stated.yaml", kQuad + "air: indoors\n");
  write_vehicle(stated, read_vehicle(stated));
  EXPECT_EQ(read_vehicle(stated).air, AirLevel::indoors);
}

TEST(VehicleAir, ThatOfTheCampaignTakesThePlaceOfThatOfTheVehicle) {
  EXPECT_EQ(air_of("", "air: calm\n"), AirLevel::calm);
  EXPECT_EQ(air_of("air: strong\n", ""), AirLevel::strong);
  EXPECT_EQ(air_of("air: strong\n", "air: calm\n"), AirLevel::strong);
}

}  // namespace
}  // namespace ident
