// Drafts of vehicle files from the parameters of logs.
#include "ident/io/draft/draft_vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "ident/core/error.h"
#include "ident/io/geometry/frame_geometry.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"

namespace ident {
namespace {

LogStreams arducopter(double kind, double type) {
  LogStreams log{.file = "flight.bin", .format = "dataflash"};
  log.parameters = {
      {"FRAME_CLASS", kind}, {"FRAME_TYPE", type}, {"MOT_PWM_MIN", 1000}, {"MOT_PWM_MAX", 2000}};
  return log;
}

std::string draft_of(const LogStreams& log) { return draft_vehicle(std::span(&log, 1)).yaml; }

TEST(DraftVehicle, SaysWhatALogCannotKnow) {
  const LogStreams log = arducopter(1, 1);
  const VehicleDraft draft = draft_vehicle(std::span(&log, 1));
  EXPECT_NE(draft.yaml.find("mass:"), std::string::npos);
  EXPECT_EQ(draft.fill_in, (std::vector<std::string>{"mass", "positions of the rotors"}));
  EXPECT_NE(draft.yaml.find("command: {min: 1000, max: 2000}"), std::string::npos) << draft.yaml;
}

TEST(DraftVehicle, ReadsAsAVehicleFile) {
  const std::string path = ::testing::TempDir() + "/draft.yaml";
  std::ofstream(path) << draft_of(arducopter(2, 1));
  const Vehicle vehicle = read_vehicle(path);
  EXPECT_EQ(vehicle.rotors.size(), 6U);
  EXPECT_EQ(vehicle.command->max_us, 2000);
  for (const char* guessed : {"m", "kT", "kQ", "km", "omega_m", "Jxx"})
    EXPECT_TRUE(vehicle.parameters.at(guessed).std.has_value()) << guessed;
  // Hover at half the command: the thrust of all rotors at km/2 carries the weight.
  const double Omega = vehicle.value("km") / 2;
  EXPECT_NEAR(6 * vehicle.value("kT") * Omega * Omega, 9.81 * vehicle.value("m"),
              0.02 * 9.81 * vehicle.value("m"));
}

TEST(DraftVehicle, MotorsOfArduPilotsXFrameSitAsItsDocumentationSays) {
  // 1 front right ccw, 2 rear left ccw, 3 front left cw, 4 rear right cw.
  const FrameGeometry frame = ardupilot_geometry(arducopter(1, 1)).value();
  const int x[] = {1, -1, 1, -1}, y[] = {1, -1, -1, 1}, s[] = {1, 1, -1, -1};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_GT(frame.rotors[n].r_B.x() * x[n], 0) << n;
    EXPECT_GT(frame.rotors[n].r_B.y() * y[n], 0) << n;
    EXPECT_EQ(frame.rotors[n].s, s[n]) << n;
  }
}

TEST(DraftVehicle, EveryFrameBalances) {
  for (int kind = 1; kind <= 3; ++kind)
    for (int type = 0; type <= 18; ++type) {
      const auto frame = ardupilot_geometry(arducopter(kind, type));
      if (!frame) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int spin = 0;
      for (const Rotor& rotor : frame->rotors) sum += rotor.r_B, spin += rotor.s;
      EXPECT_LT(sum.norm(), 1e-4) << kind << " " << type;
      EXPECT_EQ(spin, 0) << kind << " " << type;
    }
}

TEST(DraftVehicle, AFrameInNoTableIsRefused) { EXPECT_THROW(draft_of(arducopter(7, 1)), DataError); }

TEST(DraftVehicle, Px4StatesEachRotor) {
  LogStreams log{.file = "flight.ulg", .format = "ulog"};
  log.parameters = {{"CA_ROTOR_COUNT", 3},    {"CA_ROTOR0_PX", 0.1515F}, {"CA_ROTOR0_PY", 0.245F},
                    {"CA_ROTOR1_KM", -0.05F}, {"BAT1_N_CELLS", 4},       {"CA_ROTOR2_PX", -0.1F}};
  const std::string yaml = draft_of(log);
  EXPECT_NE(yaml.find("position: [0.1515, 0.245, 0], axis: [0, 0, -1], spin: ccw"), std::string::npos)
      << yaml;
  EXPECT_NE(yaml.find("spin: cw"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("battery_voltage: 14.8"), std::string::npos) << yaml;
}

}  // namespace
}  // namespace ident
