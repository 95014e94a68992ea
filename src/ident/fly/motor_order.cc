// Rotors matched with the arms of a frame.
#include "ident/fly/motor_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ident/core/error.h"
#include "ident/core/math.h"

namespace ident {
namespace {

constexpr double kWithin = 12.0;  // deg; arms of an octocopter X are 45 deg apart, of broad frames 15 deg off

double bearing(const Rotor& rotor) {
  return std::atan2(rotor.r_B[1], rotor.r_B[0]) * 180.0 / std::numbers::pi;
}

/// The spin as yaw feels it: that of an upright rotor with the same moment about the body's z axis. The slant
/// of a 4SP quadrotor turns it round.
int spin_felt(const Vehicle& vehicle, const Rotor& rotor) {
  const double kT = vehicle.value("kT"), kQ = vehicle.value("kQ");
  if (!(kT > 0) || !(kQ > 0)) return rotor.s;
  const Eigen::Vector3d a_B = axis_at(rotor, slant_angle(vehicle));
  const double moment = cross(rotor.r_B, a_B)[2] - rotor.s * kQ / kT * a_B[2];
  return moment > 0 ? 1 : -1;
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

}  // namespace

std::optional<std::vector<std::size_t>> rotors_on_frame(const Vehicle& vehicle,
                                                        std::span<const FrameArm> arms) {
  if (arms.size() != vehicle.rotors.size()) return std::nullopt;
  std::vector<std::size_t> order;
  for (const FrameArm& arm : arms) {
    std::optional<std::size_t> found;
    for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) {
      const Rotor& rotor = vehicle.rotors[n];
      const bool fits = spin_felt(vehicle, rotor) == arm.spin &&
                        apart(bearing(rotor), arm.degrees) < kWithin &&
                        std::ranges::find(order, n) == order.end();
      if (fits) found = n;
    }
    if (!found) return std::nullopt;
    order.push_back(*found);
  }
  return order;
}

MotorOrder given_order(const Vehicle& vehicle, std::span<const int> numbers) {
  std::vector<int> sorted(numbers.begin(), numbers.end());
  std::ranges::sort(sorted);
  bool whole = sorted.size() == vehicle.rotors.size();
  for (std::size_t n = 0; whole && n < sorted.size(); ++n) whole = sorted[n] == static_cast<int>(n) + 1;
  if (!whole)
    throw UsageError(fmt::format(
        "--order: the numbers of all {} rotors, each once, in the order of the autopilot's outputs, please",
        vehicle.rotors.size()));
  MotorOrder order;
  for (const int number : numbers) order.rotor_of_output.push_back(static_cast<std::size_t>(number - 1));
  order.note = order_in_words(order.rotor_of_output);
  return order;
}

std::string order_in_words(std::span<const std::size_t> rotor_of_output) {
  std::string text;
  for (std::size_t i = 0; i < rotor_of_output.size(); ++i)
    text += fmt::format("{}output {} drives rotor {}", i ? ", " : "", i + 1, rotor_of_output[i] + 1);
  return text;
}

std::string rotors_in_words(const Vehicle& vehicle) {
  std::string text;
  for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) {
    const int spin = spin_felt(vehicle, vehicle.rotors[n]);
    text += fmt::format("{}rotor {} at {:.0f} deg from the nose, {}{}", n ? "; " : "", n + 1,
                        bearing(vehicle.rotors[n]) + 0.0, spin > 0 ? "counter-clockwise" : "clockwise",
                        spin == vehicle.rotors[n].s ? "" : " by its slant");
  }
  return text;
}

}  // namespace ident
