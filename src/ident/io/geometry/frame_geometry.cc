// Geometry out of parameters: PX4's rotors one by one, ArduPilot's frames by table.
#include "ident/io/geometry/frame_geometry.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace ident {
namespace {

constexpr int kCcw = 1, kCw = -1;

double rounded(double value) { return std::round(value * 1e5) / 1e5; }  // m; parameters are floats

}  // namespace

const std::map<std::pair<int, int>, std::vector<FrameArm>>& ardupilot_frames() {
  static const std::map<std::pair<int, int>, std::vector<FrameArm>> table = {
      {{1, 0}, {{90, kCcw}, {-90, kCcw}, {0, kCw}, {180, kCw}}},      // quad, plus
      {{1, 1}, {{45, kCcw}, {-135, kCcw}, {-45, kCw}, {135, kCw}}},   // quad, X
      {{1, 3}, {{45, kCw}, {-135, kCw}, {-45, kCcw}, {135, kCcw}}},   // quad, H
      {{1, 6}, {{90, kCw}, {-90, kCw}, {0, kCcw}, {180, kCcw}}},      // quad, plus reversed
      {{1, 12}, {{135, kCw}, {45, kCcw}, {-135, kCcw}, {-45, kCw}}},  // quad, Betaflight X
      {{1, 18}, {{135, kCcw}, {45, kCw}, {-135, kCw}, {-45, kCcw}}},  // quad, Betaflight X reversed
      {{1, 13}, {{45, kCcw}, {-45, kCw}, {-135, kCcw}, {135, kCw}}},  // quad, DJI X
      {{1, 14}, {{45, kCcw}, {135, kCw}, {-135, kCcw}, {-45, kCw}}},  // quad, clockwise X
      {{2, 0}, {{0, kCw}, {180, kCcw}, {-120, kCw}, {60, kCcw}, {-60, kCcw}, {120, kCw}}},    // hexa, plus
      {{2, 1}, {{90, kCw}, {-90, kCcw}, {-30, kCw}, {150, kCcw}, {30, kCcw}, {-150, kCw}}},   // hexa, X
      {{2, 13}, {{30, kCcw}, {-30, kCw}, {-90, kCcw}, {-150, kCw}, {150, kCcw}, {90, kCw}}},  // hexa, DJI X
      {{2, 14},
       {{30, kCcw}, {90, kCw}, {150, kCcw}, {-150, kCw}, {-90, kCcw}, {-30, kCw}}},  // hexa, clockwise X
      {{3, 0},
       {{0, kCw}, {180, kCw}, {45, kCcw}, {135, kCcw}, {-45, kCcw}, {-135, kCcw}, {-90, kCw}, {90, kCw}}},
      {{3, 1},
       {{22.5, kCw},
        {-157.5, kCw},
        {67.5, kCcw},
        {157.5, kCcw},
        {-22.5, kCcw},
        {-112.5, kCcw},
        {-67.5, kCw},
        {112.5, kCw}}},
  };
  return table;
}

std::optional<FrameGeometry> px4_geometry(const LogStreams& log) {
  const int count = log.whole_parameter("CA_ROTOR_COUNT").value_or(0);
  constexpr int kMost = 12;  // CA_ROTOR11 is the last one
  if (count < 2 || count > kMost) return std::nullopt;
  FrameGeometry geometry{.arm_is_known = true, .spin_is_known = true};
  for (int n = 0; n < count; ++n) {
    const auto value = [&](const char* what, double otherwise) {
      return rounded(log.parameter(fmt::format("CA_ROTOR{}_{}", n, what)).value_or(otherwise));
    };
    Rotor rotor{.r_B = {value("PX", 0), value("PY", 0), value("PZ", 0)},
                .s = value("KM", 0.05) >= 0 ? kCcw : kCw};
    const Eigen::Vector3d axis(value("AX", 0), value("AY", 0), value("AZ", -1));
    if (axis.norm() > 0.5) rotor.a_B = axis.normalized();
    geometry.rotors.push_back(rotor);
    geometry.source.push_back(fmt::format("CA_ROTOR{}_*", n));
  }
  return geometry;
}

std::optional<FrameGeometry> ardupilot_geometry(const LogStreams& log) {
  const auto frame_class = log.whole_parameter("FRAME_CLASS"), frame_type = log.whole_parameter("FRAME_TYPE");
  const int kind = frame_class.value_or(1);  // FRAME, before 3.5, was that of a quadrotor's build
  const int type = frame_type.value_or(log.whole_parameter("FRAME").value_or(-1));
  const auto found = ardupilot_frames().find({kind, type});
  if (found == ardupilot_frames().end()) return std::nullopt;
  FrameGeometry geometry{.spin_is_known = true};
  for (const FrameArm& arm : found->second) {
    const double angle = arm.degrees * std::numbers::pi / 180.0;
    geometry.rotors.push_back(
        {.r_B = {rounded(kAssumedArm * std::cos(angle)), rounded(kAssumedArm * std::sin(angle)), 0},
         .s = arm.spin});
    geometry.source.push_back(
        fmt::format("FRAME_CLASS {}, FRAME_TYPE {}: {} deg from the nose", kind, type, arm.degrees));
  }
  return geometry;
}

FrameGeometry crazyflie_geometry() {
  constexpr double kArm = 0.0325;  // m along x and y [Bitcraze, platform_defaults_cf2.h: ARM_LENGTH 0.046]
  FrameGeometry geometry{.arm_is_known = true, .spin_is_known = true};
  const auto add = [&](double x, double y, int spin, const char* place) {
    geometry.rotors.push_back({.r_B = {x, y, 0}, .s = spin});
    geometry.source.push_back(fmt::format("M{}, {}", geometry.rotors.size(), place));
  };
  add(kArm, kArm, kCcw, "front right");
  add(-kArm, kArm, kCw, "rear right");
  add(-kArm, -kArm, kCcw, "rear left");
  add(kArm, -kArm, kCw, "front left");
  return geometry;
}

}  // namespace ident
