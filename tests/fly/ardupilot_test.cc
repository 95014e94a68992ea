// The packets of ArduPilot's JSON back end, byte by byte.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ident/core/error.h"
#include "ident/fly/autopilots.h"
#include "support/flown_vehicle.h"

namespace ident {
namespace {

std::unique_ptr<Autopilot> ardupilot() { return find_autopilot("ardupilot").make(""); }

// 0x481A = 18458, 0x0190 = 400 Hz, frame 0x01020304; 0x03E8, 0x05DC, 0x07D0 = 1000, 1500, 2000 us.
TEST(ArduPilotJson, ReadsTheServoPacketByteByByte) {
  std::string bytes("\x1a\x48\x90\x01\x04\x03\x02\x01\xe8\x03\xdc\x05\xd0\x07", 14);
  bytes.resize(40, '\0');
  const Commands commands = ardupilot()->read(bytes);
  EXPECT_EQ(commands.refused, "");
  EXPECT_EQ(commands.step, 1.0 / 400);
  EXPECT_EQ(commands.frame, 0x01020304U);
  ASSERT_EQ(commands.pulse_us.size(), 16U);
  EXPECT_EQ(commands.pulse_us[0], 1000);
  EXPECT_EQ(commands.pulse_us[1], 1500);
  EXPECT_EQ(commands.pulse_us[2], 2000);
  EXPECT_EQ(commands.pulse_us[15], 0);
}

// 0x7381 = 29569.
TEST(ArduPilotJson, ReadsThirtyTwoChannels) {
  std::string bytes("\x81\x73\xe8\x03\x00\x00\x00\x00", 8);
  bytes.resize(70, '\0');
  bytes += std::string("\xe8\x03", 2);
  const Commands commands = ardupilot()->read(bytes);
  EXPECT_EQ(commands.refused, "");
  ASSERT_EQ(commands.pulse_us.size(), 32U);
  EXPECT_EQ(commands.pulse_us[31], 1000);
}

TEST(ArduPilotJson, NamesWhatIsWrongWithADatagram) {
  const auto refused = [](std::string bytes, std::size_t size) {
    bytes.resize(size, '\0');
    return ardupilot()->read(bytes).refused;
  };
  EXPECT_EQ(refused("", 0), "0 bytes, too few for a servo packet");
  EXPECT_EQ(refused("GET / HTTP/1.1", 40), "magic 17735 where 18458 or 29569 is due");
  EXPECT_EQ(refused("\x1a\x48\x90\x01", 72), "72 bytes where 16 channels take 40");
  EXPECT_EQ(refused("\x81\x73\x90\x01", 40), "40 bytes where 32 channels take 72");
  EXPECT_EQ(refused("\x1a\x48", 40), "a frame rate of 0 Hz, ArduPilot takes 11 or more");
}

// The reader of ArduPilot finds keys by text, takes no blank after a colon and wants a line of its own.
TEST(ArduPilotJson, WritesOneLineWithTheKeysThatItsReaderLooksFor) {
  Readings r;
  r.t = 2.5, r.gyro_B = {0.1, -0.2, 0.3}, r.f_B = {1, 2, -9.8};
  r.q_WB = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // heading east
  r.v_W = {4, 5, 6}, r.x_W = {7, 8, -9}, r.start_W = {1, 1, -0.25}, r.voltage = 14.8;
  const std::string line = ardupilot()->write(r);
  ASSERT_EQ(line.front(), '\n');
  ASSERT_EQ(line.back(), '\n');
  EXPECT_EQ(line.find(' '), std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(line);
  EXPECT_EQ(json["timestamp"], 2.5);
  EXPECT_EQ(json["imu"]["gyro"], nlohmann::json({0.1, -0.2, 0.3}));
  EXPECT_EQ(json["imu"]["accel_body"], nlohmann::json({1, 2, -9.8}));
  EXPECT_EQ(json["position"], nlohmann::json({6, 7, -8.75}));
  EXPECT_EQ(json["velocity"], nlohmann::json({4, 5, 6}));
  EXPECT_NEAR(json["attitude"][2], std::acos(0.0), 1e-12);
  EXPECT_EQ(json["quaternion"][3], std::sqrt(0.5));
  EXPECT_EQ(json["battery"]["voltage"], 14.8);
}

// Front right, rear left, front left, rear right are rotors 4, 1, 2, 3 of this vehicle.
TEST(ArduPilotJson, FindsItsFrameByPlaceAndSpin) {
  const MotorOrder order = ardupilot()->order(testing::flown_quad());
  EXPECT_EQ(order.rotor_of_output, (std::vector<std::size_t>{3, 0, 1, 2}));
  EXPECT_EQ(
      order.note,
      "FRAME_CLASS 1 (quad), FRAME_TYPE 1: output 1 drives rotor 4, output 2 drives rotor 1, output 3 drives "
      "rotor 2, output 4 drives rotor 3");
}

// The same places with all spins turned round are ArduPilot's frame H.
TEST(ArduPilotJson, KnowsReversedSpinsAsAnotherFrame) {
  Vehicle v = testing::flown_quad();
  for (Rotor& rotor : v.rotors) rotor.s = -rotor.s;
  EXPECT_EQ(ardupilot()->order(v).note.find("FRAME_CLASS 1 (quad), FRAME_TYPE 3"), 0U);
}

// All four propellers of a 4SP quadrotor turn counter-clockwise; the slant of its second pair, twice what
// their drag torque asks for, yaws it like clockwise ones [Phang 24].
TEST(ArduPilotJson, ASlantCountsAsTheSpinThatYawFeels) {
  Vehicle v = testing::flown_quad();
  v.rotors = layout_rotors("4sp", 0.17, 0.166);
  v.parameters["alpha"] = {0.166, {}}, v.parameters["kT"] = {6.1e-6, {}}, v.parameters["kQ"] = {8.7e-8, {}};
  EXPECT_EQ(ardupilot()->order(v).note.find("FRAME_CLASS 1 (quad), FRAME_TYPE 6"), 0U)
      << ardupilot()->order(v).note;
  v.parameters["alpha"] = {0.0, {}};
  EXPECT_THROW(ardupilot()->order(v), UsageError);
}

TEST(ArduPilotJson, AsksForAnOrderWhereNoFrameFits) {
  Vehicle v = testing::flown_quad();
  v.rotors[2].s = 1;
  try {
    ardupilot()->order(v);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("rotor 3 at 135 deg from the nose, counter-clockwise"),
              std::string::npos)
        << error.what();
  }
}

TEST(MotorOrder, TakesEachRotorOnce) {
  const Vehicle v = testing::flown_quad();
  EXPECT_EQ(given_order(v, std::vector<int>{2, 1, 4, 3}).rotor_of_output,
            (std::vector<std::size_t>{1, 0, 3, 2}));
  EXPECT_THROW(given_order(v, std::vector<int>{1, 2, 3}), UsageError);
  EXPECT_THROW(given_order(v, std::vector<int>{1, 2, 3, 3}), UsageError);
  EXPECT_THROW(given_order(v, std::vector<int>{0, 1, 2, 3}), UsageError);
}

TEST(Autopilots, AnUnknownNameIsMetWithTheNearest) {
  try {
    find_autopilot("ardupilto");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'ardupilot'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ident
