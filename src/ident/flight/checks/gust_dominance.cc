// What a state feels from outside against what its rate changes by until the next.
#include "ident/flight/checks/gust_dominance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "ident/flight/checks/implausible_estimates.h"

namespace ident {
namespace {

// Of 60 flights by a controller at 0.4 to 2 kHz, half of them in gusts of 0.05 to 0.3 s, moments of inertia
// came out 10 to 80 % too small, by up to 50 of their deviations, beyond a ratio of 0.55 with gusts that the
// fit took for up to 0.35 s long, and beyond 0.83 with those that it took for up to 1.1 s. In gusts of 1.5 s
// they are right up to 0.9, and those of a brushed Crazyflie at 0.6, with 0.7 s.
constexpr double kMost = 0.5, kQuick = 0.5, kMuch = 0.75, kQuickOfMuch = 0.9;  // ratios; s
// Of roll and pitch, where the other is blown about: it was 0.46 where Jyy came out 13 % off.
constexpr double kMostBeside = 0.4;

bool is_quick(const AirShare& air, std::size_t axis) {
  const double ratio = air.over_rotors[axis];
  return ratio > kMost && air.seconds[axis] < (ratio > kMuch ? kQuickOfMuch : kQuick);
}

}  // namespace

std::array<double, 3> TurnedBy::air_over_rotors() const {
  std::array<double, 3> ratio{};
  for (Eigen::Index i = 0; i < 3; ++i)
    if (rotors_[i] > 0) ratio[static_cast<std::size_t>(i)] = std::sqrt(air_[i] / rotors_[i]);
  return ratio;
}

AirShare air_share(const FlightRecord& record, const FlightFit& fit) {
  const FlightSmoother& smoother = *fit.smoother;
  TurnedBy turned;
  for (std::size_t k = 0; k + 1 < smoother.chunks().size(); ++k) {
    const ChunkPlace &place = smoother.chunks()[k], &next = smoother.chunks()[k + 1];
    if (next.arc != place.arc) continue;
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    const FlightState<double>&state = smoother.states()[k], &after = smoother.states()[k + 1];
    turned.add(arc.t[next.begin] - arc.t[place.begin], after.body.w_B - state.body.w_B,
               state.outside.w_dot_B);
  }
  AirShare share{.over_rotors = turned.air_over_rotors()};
  for (std::size_t i = 0; i < 3; ++i)
    for (const AirNoise& of_log : fit.noise.air)
      if (const double tau = of_log.w_dot[i].tau; share.seconds[i] == 0 || tau < share.seconds[i])
        share.seconds[i] = tau;
  return share;
}

void warn_of_air(Result& result, const AirShare& air) {
  constexpr std::array kAxes = {"roll", "pitch", "yaw"};
  constexpr const char* kWhy = "quick gusts turn the vehicle about as much as its rotors do";
  std::vector<std::string> found;
  // How long gusts last is hardly told where they are that strong: roll and pitch speak for each other.
  const bool across = is_quick(air, 0) || is_quick(air, 1);
  const auto is_blown = [&](std::size_t axis) {
    return axis == 2 ? is_quick(air, 2) : across && air.over_rotors[axis] > kMostBeside;
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (is_blown(i)) found.push_back(fmt::format("{} ({:.2g})", kAxes[i], air.over_rotors[i]));
  if (found.empty()) return;
  if (is_blown(0)) doubt_all(result, {"Jxx", "Jxy", "Jxz"}, kWhy);
  if (is_blown(1)) doubt_all(result, {"Jyy", "Jxy", "Jyz"}, kWhy);
  if (is_blown(2)) doubt_all(result, {"Jzz", "Jp", "kQ", "Jxz", "Jyz"}, kWhy);
  if (is_blown(0) || is_blown(1)) doubt_all(result, {"omega_m", "zeta_m", "dead_time", "kT"}, kWhy);
  result.warn(
      "air_turns",
      fmt::format(
          "About {} short gusts turn the vehicle about as much as its rotors do (ratio in brackets). The "
          "controller's answer to them passes for dynamics of the vehicle, so inertia, motors and kT are not "
          "identifiable. Fly in calm air, with doublets or a multisine about every axis.",
          fmt::join(found, ", ")));
}

}  // namespace ident
