// Betaflight SITL [betaflight, src/platform/SIMULATOR/sitl.c, sitl_gyro.h, target/SITL/target.h; before 2025
// src/main/target/SITL]: it runs against the clock, is told its state and answers each with motor outputs.
//
//   in, 16 bytes:   float motor[4], 0 to 1                      servo_packet, its port 9002
//   in, 68 bytes:   u16 count, u16 -, float pulse us [16]       servo_packet_raw, its port 9001
//   out, 144 bytes: double t, rates[3], acceleration[3], q[4], velocity[3], position[3], pressure
//
// Inside, Betaflight's body is forward, left, up and its attitude that to north, west, up. It negates all of
// `acceleration` and the second and third of `rates` (with the Gazebo bridge the second alone); what is sent
// undoes that. Longitude, latitude, altitude and velocities east, north, up are for its virtual GPS.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ident/core/error.h"
#include "ident/fly/autopilot.h"
#include "ident/io/packed/little_endian.h"

namespace ident {
namespace {

constexpr std::size_t kServoPacket = 16, kRawPacket = 68, kMostRaw = 16;
constexpr double kLatitude = 47.397742, kLongitude = 8.545594,
                 kAltitude = 488.0;    // deg, m: a field in Zurich
constexpr double kDegree = 111319.49;  // m along the equator
constexpr double kRootHalf = std::numbers::sqrt2 / 2;

/// Pa in the standard atmosphere, as in sitl.c.
double pressure(double altitude) { return 101325.0 * std::pow(1.0 - 2.25577e-5 * altitude, 5.25588); }

/// How a build of Betaflight SITL reads.
enum class Build {
  released,  ///< 4.x and 2025.12: takes FRD to NED for its attitude; outputs as Gazebo's plugin had them
  bridge,    ///< 2026 with ENABLE_GAZEBO_BRIDGE=0
  gazebo     ///< 2026 as it is built by default
};

class Betaflight : public Autopilot {
 public:
  explicit Betaflight(Build build) : build_(build) {}

  Commands read(std::string_view datagram) const override {
    Commands commands;
    if (datagram.size() == kServoPacket) {
      std::array<double, 4> motor{};
      // Released builds send motors 2, 3, 4, 1.
      for (std::size_t i = 0; i < 4; ++i)
        motor[build_ == Build::released ? (i + 1) % 4 : i] =
            1000.0 + 1000.0 * static_cast<double>(load<float>(datagram.data() + 4 * i));
      commands.pulse_us.assign(motor.begin(), motor.end());
    } else if (datagram.size() == kRawPacket) {
      const std::size_t count = load<std::uint16_t>(datagram.data());
      if (count > kMostRaw) commands.refused = fmt::format("{} motors in a packet for {}", count, kMostRaw);
      for (std::size_t i = 0; i < std::min(count, kMostRaw); ++i)
        commands.pulse_us.push_back(static_cast<double>(load<float>(datagram.data() + 4 + 4 * i)));
    } else {
      commands.refused = fmt::format("{} bytes, a servo packet has {} and a raw one {}", datagram.size(),
                                     kServoPacket, kRawPacket);
    }
    for (const double pulse : commands.pulse_us)
      if (!std::isfinite(pulse)) commands.refused = "a motor output that is no number";
    return commands;
  }

  std::string write(const Readings& r) const override {
    const Vec3<double> moved = r.x_W - r.start_W;
    const double north = moved[0] / kDegree,
                 east = moved[1] / (kDegree * std::cos(kLatitude * std::numbers::pi / 180.0));
    const bool gazebo = build_ == Build::gazebo;
    const double mirror = gazebo ? -1.0 : 1.0;  // it mirrors positions at the first one
    const Vec4<double> q = attitude(r.q_WB);
    const double altitude = kAltitude - moved[2];
    const std::array<double, 18> packet = {r.t,
                                           r.gyro_B[0],
                                           r.gyro_B[1],
                                           gazebo ? -r.gyro_B[2] : r.gyro_B[2],
                                           -r.f_B[0],
                                           r.f_B[1],
                                           r.f_B[2],
                                           q[0],
                                           q[1],
                                           q[2],
                                           q[3],
                                           r.v_W[1],
                                           r.v_W[0],
                                           -r.v_W[2],
                                           kLongitude + mirror * east,
                                           kLatitude + mirror * north,
                                           altitude,
                                           pressure(altitude)};
    return {reinterpret_cast<const char*>(packet.data()), sizeof packet};
  }

  MotorOrder order(const Vehicle& vehicle) const override {
    for (const auto& [type, reversed] : {std::pair{12, "OFF"}, std::pair{18, "ON"}}) {
      const auto rotors = rotors_on_frame(vehicle, ardupilot_frames().at({1, type}));
      if (rotors)
        return {*rotors, fmt::format("mixer QUADX, set yaw_motors_reversed = {}: {}", reversed,
                                     order_in_words(*rotors))};
    }
    throw UsageError(
        fmt::format("the rotors are not those of Betaflight's QUADX ({}): give --order, the rotor of "
                    "each motor in turn",
                    rotors_in_words(vehicle)));
  }

 private:
  /// FRD to NED as the build takes it.
  Vec4<double> attitude(const Vec4<double>& q_WB) const {
    if (build_ == Build::released) return q_WB;
    Vec4<double> q(q_WB[0], q_WB[1], -q_WB[2], -q_WB[3]);  // forward, left, up to north, west, up
    if (build_ == Build::bridge) return q;
    // It turns about x by 180 degrees, then by 90 degrees to the left.
    const Vec4<double> right(kRootHalf, 0.0, 0.0, -kRootHalf);
    const Vec4<double> turned = quaternion_product(right, q);
    return {turned[0], turned[1], -turned[2], -turned[3]};
  }

  Build build_;
};

}  // namespace

AutopilotInfo betaflight_autopilot() {
  return {.name = "betaflight",
          .meaning = "Betaflight SITL, against the clock",
          .port = 9002,
          .state_port = 9003,
          .rate = 1000.0,
          .builds = {"released", "bridge", "gazebo"},
          .make = [](const std::string& build) -> std::unique_ptr<Autopilot> {
            return std::make_unique<Betaflight>(build == "gazebo"   ? Build::gazebo
                                                : build == "bridge" ? Build::bridge
                                                                    : Build::released);
          },
          .start = "obj/main/betaflight_SITL.elf"};
}

}  // namespace ident
