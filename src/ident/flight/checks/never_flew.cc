// Slow motion of every sensor, and thrust against weight as far as either is known.
#include "ident/flight/checks/never_flew.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kMeanOver = 0.25;       // s: vibration of idling rotors averages out
constexpr double kStillRate = 0.02;      // rad/s, 1 deg/s: no pilot and no controller holds a vehicle stiller
constexpr double kStillForce = 0.3;      // m/s^2
constexpr double kStillVelocity = 0.15;  // m/s
constexpr double kStillPlace = 0.1;      // m
constexpr double kCarries = 0.5;         // of the weight
constexpr double kStrongest = 10.0;      // full thrust over weight of racing vehicles

/// Largest distance of means over `kMeanOver` from the median of them; nothing where nothing was measured.
std::optional<double> slow_motion(const std::vector<double>& t, std::span<const double> values) {
  std::vector<double> means;
  double sum = 0.0, count = 0.0, begin = kNaN;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    if (std::isnan(begin)) begin = t[i];
    if (t[i] - begin >= kMeanOver && count > 0.0) {
      means.push_back(sum / count);
      sum = count = 0.0, begin = t[i];
    }
    sum += values[i], count += 1.0;
  }
  if (means.size() < 2) return std::nullopt;
  const double middle = median(means);
  double most = 0.0;
  for (const double m : means) most = std::max(most, std::fabs(m - middle));
  return most;
}

/// Does any axis of a group move by more than that?
template <class Group>
bool moves(const FlightLog& log, const Group& group, double still) {
  return std::ranges::any_of(
      group, [&](const std::vector<double>& axis) { return slow_motion(log.t, axis).value_or(0.0) > still; });
}

double mean_of(const std::vector<std::vector<double>>& rotors, bool squared) {
  double sum = 0.0, count = 0.0;
  for (const std::vector<double>& rotor : rotors)
    for (const double v : rotor)
      if (std::isfinite(v)) sum += squared ? v * v : v, count += 1.0;
  return count > 0.0 ? sum / count : kNaN;
}

/// Thrust over weight: from speeds and kT, else the most that any vehicle has at these commands.
double carried(const FlightLog& log, const Vehicle& vehicle) {
  const double weight = vehicle.value("m") * vehicle.g, rotors = static_cast<double>(vehicle.rotors.size());
  if (log.has_rotor_speeds() && vehicle.has("kT") && weight > 0.0)
    return rotors * vehicle.value("kT") * mean_of(log.Omega, true) / weight;
  if (log.has_commands()) return kStrongest * mean_of(log.delta, false);
  return kNaN;
}

}  // namespace

std::string never_flew(const FlightLog& log, const Vehicle& vehicle) {
  const bool known = log.has_rates() || log.has_specific_force();
  if (!known || moves(log, log.w_B, kStillRate) || moves(log, log.f_B, kStillForce) ||
      moves(log, log.v_W, kStillVelocity) || moves(log, log.x_W, kStillPlace))
    return "";
  const double share = carried(log, vehicle);
  const double enough = log.has_rotor_speeds() && vehicle.has("kT") ? kCarries : 1.0;
  if (!(share < enough)) return "";
  return fmt::format(
      "{}: nothing flew: rates, specific force and place stay as they are within {} deg/s and {} m/s^2 "
      "over {:.0f} s, and the rotors carry {:.0f} % of the weight at most: the vehicle stood, armed at "
      "most. Nothing of it can be told from this log; give one that takes off",
      log.file, std::round(kStillRate * 180.0 / M_PI), kStillForce, log.t.back() - log.t.front(),
      100.0 * share);
}

}  // namespace ident
