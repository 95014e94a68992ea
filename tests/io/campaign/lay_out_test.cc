// A campaign laid out from the files of a folder reads back as the campaign that was meant.
#include "ident/io/campaign/lay_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ident/core/error.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

const std::string kSweep = "omega,thrust,torque\n100,0.06,0.001\n200,0.24,0.004\n300,0.54,0.009\n";
const std::string kVehicle = "layout: x\narm: 0.17\nmass: 0.5\n";

/// Rates that change from row to row, with commands under these names.
std::string log_text(const std::string& header, const char* command) {
  std::string text = header + "\n";
  for (int i = 0; i < 200; ++i) {
    text += std::to_string(0.01 * i);
    for (int n = 0; n < 4; ++n) text += std::string(",") + command;
    for (int k = 1; k <= 3; ++k) text += "," + std::to_string(0.01 * ((i * (7 + k)) % 11));
    text += "\n";
  }
  return text;
}

std::string normalised() { return log_text("t,delta1,delta2,delta3,delta4,p,q,r", "0.5"); }

/// Writes what was laid out, and reads it as a command does.
Campaign read_back(const LaidOutCampaign& layout, const std::string& folder) {
  write_text(folder, "ident.yaml", layout.text);
  if (!layout.drafted.empty()) write_text(folder, "vehicle.yaml", layout.drafted);
  return read_campaign(folder);
}

std::string why_left(const LaidOutCampaign& layout, const std::string& name) {
  const auto at =
      std::ranges::find_if(layout.left, [&](const FoundFile& f) { return f.path.ends_with("/" + name); });
  return at == layout.left.end() ? "" : at->what;
}

TEST(LayOut, NamesEveryFileOnceAsSeenFromTheFolder) {
  const std::string folder = test_folder();
  fs::create_directories(fs::path(folder) / "flights");
  write_text(folder, "quad.txt", kVehicle);
  write_text(folder, "sweep 1", kSweep);
  write_text(folder, "flights/one.csv", normalised());
  const LaidOutCampaign layout = lay_out_campaign(folder);
  EXPECT_TRUE(layout.drafted.empty());
  EXPECT_NE(layout.text.find("thrust: \"sweep 1\""), std::string::npos) << layout.text;
  EXPECT_NE(layout.text.find("logs: flights/one.csv"), std::string::npos) << layout.text;
  const Campaign campaign = read_back(layout, folder);
  EXPECT_TRUE(fs::equivalent(campaign.vehicle, folder + "/quad.txt"));
  ASSERT_EQ(campaign.logs.size(), 1U);
  EXPECT_TRUE(fs::equivalent(campaign.logs[0].file, folder + "/flights/one.csv"));
  EXPECT_EQ(layout.now, (std::vector<std::string>{"ident thrust", "ident gap", "ident flightlog --refine",
                                                  "ident check"}));
  EXPECT_TRUE(layout.fill_in.empty());
}

TEST(LayOut, WithoutAVehicleFileBenchCommandsWorkAndTheRestIsToBeFilledIn) {
  const std::string folder = test_folder();
  write_text(folder, "sweep.csv", kSweep);
  write_text(folder, "log.csv", normalised());
  const LaidOutCampaign layout = lay_out_campaign(folder);
  EXPECT_TRUE(read_vehicle(read_back(layout, folder).vehicle).rotors.empty());
  EXPECT_EQ(layout.now, (std::vector<std::string>{"ident thrust"}));
  EXPECT_EQ(layout.later, (std::vector<std::string>{"ident gap", "ident flightlog --refine", "ident check"}));
  EXPECT_EQ(layout.fill_in, (std::vector<std::string>{"mass", "rotors, or layout and arm"}));
}

/// A text log of ArduPilot: a quadrotor of that FRAME_TYPE, its motors at half.
std::string ardupilot_log(int frame_type) {
  std::string text =
      "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n"
      "FMT, 129, 31, PARM, QNf, TimeUS,Name,Value\n"
      "FMT, 130, 35, IMU, Qffffff, TimeUS,GyrX,GyrY,GyrZ,AccX,AccY,AccZ\n"
      "FMT, 131, 19, RCOU, QHHHH, TimeUS,C1,C2,C3,C4\n";
  const auto parameter = [&](const char* name, int value) {
    text += std::string("PARM, 1000, ") + name + ", " + std::to_string(value) + "\n";
  };
  parameter("FRAME_CLASS", 1), parameter("FRAME_TYPE", frame_type);
  parameter("MOT_PWM_MIN", 1000), parameter("MOT_PWM_MAX", 2000);
  for (int n = 1; n <= 4; ++n) parameter(("SERVO" + std::to_string(n) + "_FUNCTION").c_str(), 32 + n);
  for (int i = 0; i < 1000; ++i) {
    const std::string t = std::to_string(10000 * (i + 1)), rate = std::to_string(0.01 * (i * 7 % 11));
    text += "IMU, " + t + ", " + rate + ", 0.01, 0.02, 0.1, " + rate + ", -9.8\n";
    text += "RCOU, " + t + ", " + std::to_string(1500 + i * 3 % 7) + ", 1500, 1502, 1501\n";
  }
  return text;
}

TEST(LayOut, WithoutAVehicleFileItIsDraftedFromLogsOfAutopilots) {
  const std::string folder = test_folder();
  write_text(folder, "one", ardupilot_log(1));
  write_text(folder, "two", ardupilot_log(0));  // plus, not X
  const LaidOutCampaign layout = lay_out_campaign(folder);
  const Campaign campaign = read_back(layout, folder);
  EXPECT_EQ(campaign.logs.size(), 2U) << (layout.left.empty() ? "" : layout.left[0].what);
  EXPECT_EQ(read_vehicle(campaign.vehicle).rotors.size(), 4U);
  EXPECT_EQ(layout.fill_in, (std::vector<std::string>{"mass", "positions of the rotors"}));
  EXPECT_EQ(layout.now.front(), "ident gap");
  ASSERT_EQ(layout.warnings.size(), 1U);
  EXPECT_EQ(layout.warnings[0].code, "other_frame");
}

TEST(LayOut, PulseWidthsAskForTheirRange) {
  const std::string folder = test_folder();
  write_text(folder, "quad.yaml", kVehicle);
  write_text(folder, "log.csv", log_text("t,u1,u2,u3,u4,p,q,r", "1500"));
  const LaidOutCampaign layout = lay_out_campaign(folder);
  EXPECT_EQ(layout.campaign.logs.size(), 1U);
  EXPECT_EQ(layout.later, (std::vector<std::string>{"ident gap", "ident flightlog --refine"}));
  ASSERT_EQ(layout.fill_in.size(), 1U);
  EXPECT_TRUE(layout.fill_in[0].starts_with("command")) << layout.fill_in[0];
}

TEST(LayOut, ALogWithOtherNamesIsReadByTheMapThatFitsIt) {
  const std::string folder = test_folder();
  write_text(folder, "quad.yaml", kVehicle);
  write_text(folder, "names.yaml",
             "columns: {t: t_s, delta1: m1, delta2: m2, delta3: m3, delta4: m4, p: gx, q: gy, r: gz}\n");
  write_text(folder, "idle.yaml", "columns: {t: clock}\n");
  write_text(folder, "log.csv", log_text("t_s,m1,m2,m3,m4,gx,gy,gz", "0.5"));
  const LaidOutCampaign layout = lay_out_campaign(folder);
  const Campaign campaign = read_back(layout, folder);
  ASSERT_EQ(campaign.logs.size(), 1U);
  EXPECT_TRUE(campaign.logs[0].map.ends_with("names.yaml")) << campaign.logs[0].map;
  EXPECT_NE(why_left(layout, "idle.yaml").find("no log here needs"), std::string::npos);
}

TEST(LayOut, WhatCommandsCouldNotReadIsLeftAlone) {
  const std::string folder = test_folder();
  write_text(folder, "quad.yaml", kVehicle);
  write_text(folder, "a.csv", normalised());
  write_text(folder, "b.csv", normalised());
  write_text(
      folder, "six.csv",
      "t,delta1,delta2,delta3,delta4,delta5,delta6,p\n0,.5,.5,.5,.5,.5,.5,0\n0.01,.5,.5,.5,.5,.5,.5,1\n");
  write_text(folder, "nan.csv", "omega,thrust\nnan,nan\nnan,nan\n");
  write_text(folder, "old.yaml", "parameters: {kT: 6e-6}\n");
  const LaidOutCampaign layout = lay_out_campaign(folder);
  EXPECT_EQ(layout.campaign.logs.size(), 1U);
  EXPECT_TRUE(layout.campaign.thrust.empty());
  EXPECT_NE(why_left(layout, "b.csv").find("same bytes"), std::string::npos);
  EXPECT_NE(why_left(layout, "six.csv").find("4 rotors"), std::string::npos) << why_left(layout, "six.csv");
  EXPECT_FALSE(why_left(layout, "nan.csv").empty());
  EXPECT_NE(why_left(layout, "old.yaml").find("parameter file"), std::string::npos);
}

TEST(LayOut, SeveralVehiclesAreForTheUserToChooseFrom) {
  const std::string folder = test_folder();
  write_text(folder, "a.yaml", kVehicle);
  const std::string b = write_text(folder, "b.yaml", "name: b\n" + kVehicle);
  EXPECT_THROW(lay_out_campaign(folder), UsageError);
  const LaidOutCampaign layout = lay_out_campaign(folder, b);
  EXPECT_EQ(layout.campaign.vehicle, b);
  EXPECT_NE(why_left(layout, "a.yaml").find("the campaign's is b.yaml"), std::string::npos);
}

TEST(LayOut, WhatIsThereIsNotOverwritten) {
  const std::string folder = test_folder();
  EXPECT_THROW(lay_out_campaign(folder), DataError);  // nothing there
  write_text(folder, "sweep.csv", kSweep);
  write_text(folder, "vehicle.yaml", "layout: x\narn: 0.17\n");
  EXPECT_THROW(lay_out_campaign(folder), InputError);
  write_text(folder, "vehicle.yaml", kVehicle);
  EXPECT_NO_THROW(lay_out_campaign(folder));
  write_text(folder, "ident.yaml", "vehicle: vehicle.yaml\n");
  EXPECT_THROW(lay_out_campaign(folder), InputError);
}

}  // namespace
}  // namespace ident
