// The packets of Betaflight SITL, and the vehicle flown by its conventions in all three builds.
#include <gtest/gtest.h>

#include <cstring>

#include "ident/core/error.h"
#include "ident/fly/autopilots.h"
#include "support/fake_autopilot.h"
#include "support/flown_vehicle.h"

namespace ident {
namespace {

using testing::BetaflightBuild;
using testing::BetaflightView;

const std::vector<std::pair<std::string, BetaflightBuild>> kBuilds = {{"released", BetaflightBuild::released},
                                                                      {"bridge", BetaflightBuild::bridge},
                                                                      {"gazebo", BetaflightBuild::gazebo}};

std::unique_ptr<Autopilot> betaflight(const std::string& build) {
  return find_autopilot("betaflight").make(build);
}

// 0x3F000000 is 0.5 as a float, 0x3F800000 is 1, 0x3E800000 is 0.25.
TEST(BetaflightSitl, ReadsTheServoPacketInTheOrderOfEachBuild) {
  const std::string bytes("\x00\x00\x00\x3f\x00\x00\x80\x3f\x00\x00\x80\x3e\x00\x00\x00\x00", 16);
  EXPECT_EQ(betaflight("released")->read(bytes).pulse_us, (std::vector<double>{1000, 1500, 2000, 1250}));
  EXPECT_EQ(betaflight("bridge")->read(bytes).pulse_us, (std::vector<double>{1500, 2000, 1250, 1000}));
  EXPECT_EQ(betaflight("gazebo")->read(bytes).pulse_us, (std::vector<double>{1500, 2000, 1250, 1000}));
}

// u16 count 4, two bytes of padding, then floats: 0x447A0000 is 1000, 0x44FA0000 is 2000.
TEST(BetaflightSitl, ReadsTheRawPacket) {
  std::string bytes("\x04\x00\xff\xff\x00\x00\x7a\x44\x00\x00\xfa\x44\x00\x00\x7a\x44\x00\x00\x7a\x44", 20);
  bytes.resize(68, '\0');
  EXPECT_EQ(betaflight("released")->read(bytes).pulse_us, (std::vector<double>{1000, 2000, 1000, 1000}));
}

TEST(BetaflightSitl, NamesWhatIsWrongWithADatagram) {
  EXPECT_EQ(betaflight("released")->read("abc").refused, "3 bytes, a servo packet has 16 and a raw one 68");
  EXPECT_EQ(betaflight("released")->read(std::string("\x00\x00\xc0\x7f", 4) + std::string(12, '\0')).refused,
            "a motor output that is no number");
  EXPECT_EQ(betaflight("released")->read("\xff\xff" + std::string(66, '\0')).refused,
            "65535 motors in a packet for 16");
}

Readings tilted() {
  Readings r;
  r.t = 1.5, r.gyro_B = {0.1, 0.2, 0.3};
  // Rolled 0.3 rad to the right, nose up by 0.2 rad, heading 0.5 rad east of north.
  const auto about = [](int axis, double angle) {
    Vec4<double> q(std::cos(angle / 2), 0, 0, 0);
    q[axis] = std::sin(angle / 2);
    return q;
  };
  r.q_WB = quaternion_product(Vec4<double>(quaternion_product(about(3, 0.5), about(2, 0.2))), about(1, 0.3));
  r.f_B = rotation(r.q_WB).transpose() * Vec3<double>(0, 0, -9.80665);
  r.v_W = {1, 2, -3}, r.x_W = {11, 20, -30}, r.start_W = {0, 0, 0};
  return r;
}

TEST(BetaflightSitl, WritesEighteenDoublesInTheOrderOfTheFdmPacket) {
  const std::string bytes = betaflight("released")->write(tilted());
  ASSERT_EQ(bytes.size(), 144U);
  std::array<double, 18> p{};
  std::memcpy(p.data(), bytes.data(), sizeof p);
  EXPECT_EQ(p[0], 1.5);
  EXPECT_EQ(p[1], 0.1);
  EXPECT_EQ(p[2], 0.2);
  EXPECT_EQ(p[3], 0.3);
  const Readings r = tilted();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(p[static_cast<std::size_t>(7 + i)], r.q_WB[i]);
  EXPECT_EQ(p[11], 2);  // east, north, up
  EXPECT_EQ(p[12], 1);
  EXPECT_EQ(p[13], 3);
  EXPECT_NEAR(p[15] - 47.397742, 11 / 111319.49, 1e-9);  // latitude: 11 m north
  EXPECT_GT(p[14], 8.545594);
  EXPECT_NEAR(p[16], 488 + 30, 1e-9);
  EXPECT_NEAR(p[17], 101325 * std::pow(1 - 2.25577e-5 * 518, 5.25588), 1e-6);
}

TEST(BetaflightSitl, EachBuildSeesTheSameMotionThroughItsOwnSigns) {
  for (const auto& [name, build] : kBuilds) {
    const BetaflightView view = testing::received(betaflight(name)->write(tilted()), build);
    const testing::Attitude seen = testing::pilots_view(view);
    EXPECT_NEAR(seen.roll, 0.3, 1e-12) << name;
    EXPECT_NEAR(seen.pitch, 0.2, 1e-12) << name;
    EXPECT_NEAR(seen.yaw, 0.5, 1e-12) << name;
    EXPECT_EQ(seen.roll_rate, 0.1) << name;
    EXPECT_EQ(seen.pitch_rate, 0.2) << name;
    EXPECT_EQ(seen.yaw_rate, 0.3) << name;
    // At rest the accelerometer shows up in the body: forward with the nose up, left with the right side
    // down.
    EXPECT_NEAR(view.accelerometer[0], 9.80665 * std::sin(0.2), 1e-9) << name;
    EXPECT_NEAR(view.accelerometer[1], 9.80665 * std::cos(0.2) * std::sin(0.3), 1e-9) << name;
    EXPECT_NEAR(view.accelerometer[2], 9.80665 * std::cos(0.2) * std::cos(0.3), 1e-9) << name;
  }
}

TEST(BetaflightSitl, MatchesQuadXAndSaysHowYawIsSet) {
  Vehicle v = testing::flown_quad();
  // Rear right, front right, rear left, front left.
  EXPECT_EQ(betaflight("released")->order(v).rotor_of_output, (std::vector<std::size_t>{2, 3, 0, 1}));
  EXPECT_NE(betaflight("released")->order(v).note.find("yaw_motors_reversed = OFF"), std::string::npos);
  for (Rotor& rotor : v.rotors) rotor.s = -rotor.s;
  EXPECT_NE(betaflight("released")->order(v).note.find("yaw_motors_reversed = ON"), std::string::npos);
  v.rotors.push_back(v.rotors[0]);
  EXPECT_THROW(betaflight("released")->order(v), UsageError);
}

/// The loop without sockets: what is written is received by the build, its motors come back through read.
class Loop {
 public:
  Loop(const std::string& name, BetaflightBuild build)
      : build_(build),
        autopilot_(betaflight(name)),
        vehicle_(testing::flown_quad()),
        order_(autopilot_->order(vehicle_.vehicle())) {}

  testing::Attitude fly(const testing::Wish& wish, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000); ++i) {
      const auto motors = testing::betaflight_motors(testing::controlled(seen(), wish));
      const Commands commands = autopilot_->read(testing::motor_packet(motors, build_));
      std::vector<double> delta(4);
      for (std::size_t k = 0; k < 4; ++k)
        delta[order_.rotor_of_output[k]] = (commands.pulse_us[k] - 1000) / 1000;
      vehicle_.step(delta, 1e-3);
    }
    return seen();
  }
  const Readings& readings() const { return vehicle_.readings(); }

 private:
  testing::Attitude seen() const {
    return testing::pilots_view(testing::received(autopilot_->write(vehicle_.readings()), build_));
  }
  BetaflightBuild build_;
  std::unique_ptr<Autopilot> autopilot_;
  ServedVehicle vehicle_;
  MotorOrder order_;
};

TEST(BetaflightSitl, FliesInTheDirectionOfEveryStickInEveryBuild) {
  for (const auto& [name, build] : kBuilds) {
    Loop loop(name, build);
    loop.fly({.climb = 1.5}, 3);
    EXPECT_LT(loop.readings().x_W[2], -2) << name;
    EXPECT_NEAR(loop.fly({.roll = 0.2}, 1).roll, 0.2, 0.05) << name;
    EXPECT_GT(loop.readings().v_W[1], 0.8) << name << ": rolled right, it goes east";
    loop.fly({.roll = -0.2}, 1.2);
    EXPECT_NEAR(loop.fly({.pitch = -0.2}, 1).pitch, -0.2, 0.05) << name;
    EXPECT_GT(loop.readings().v_W[0], 0.8) << name << ": nose down, it goes north";
    loop.fly({.pitch = 0.2}, 1.2);
    const double before = loop.fly({}, 0.5).yaw;
    EXPECT_GT(loop.fly({.yaw_rate = 0.6}, 1.5).yaw - before, 0.4) << name << ": yawed right, it heads east";
    const Mat3<double> R_WB = rotation(loop.readings().q_WB);
    EXPECT_GT(R_WB(1, 0), 0.3) << name;
  }
}

}  // namespace
}  // namespace ident
