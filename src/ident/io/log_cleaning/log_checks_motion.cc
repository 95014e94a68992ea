// Rates, attitude, velocity and position against each other: units and axes.
#include "ident/io/log_cleaning/log_checks_motion.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/log_cleaning/log_rows.h"

namespace ident {
namespace {

/// Angle between two attitudes.
double turn(const FlightLog& log, std::size_t a, std::size_t b) {
  double dot = 0.0;
  for (const std::vector<double>& c : log.q_WB) dot += c[a] * c[b];
  return 2.0 * std::acos(std::min(1.0, std::abs(dot)));
}

// How fast attitude turns with the rates, by the slope of its squared turns over those of the rates: noise of
// the attitude adds to all of them alike.
double turns_with_rates(std::span<const std::array<double, 2>> squares) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(squares.size());
  for (const auto& [by_rates, by_attitude] : squares) x += by_rates / n, y += by_attitude / n;
  for (const auto& [by_rates, by_attitude] : squares)
    xx += (by_rates - x) * (by_rates - x), xy += (by_rates - x) * (by_attitude - y);
  return xx > 0 ? std::sqrt(std::max(xy / xx, 0.0)) : 0.0;
}

}  // namespace

void check_rates_against_attitude(const FlightLog& log, long header_line, bool quaternions) {
  if (!log.has_rates() || !log.has_attitude()) return;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::vector<std::array<double, 2>> squares;  // of short turns, by rates and by attitude
  constexpr double kWindow = 0.02;  // s: short against a turn, even of angles that are taken for radians
  constexpr double kTurning = 0.1;  // rad/s: below it noise tells nothing
  double by_attitude = 0.0, by_rates = 0.0, rate_sum = 0.0;
  long rates = 0;
  std::optional<std::size_t> start;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const double rate = norm(log.w_B, i);
    if (!std::isnan(rate)) rate_sum += rate, ++rates;
    if (std::isnan(log.q_WB[0][i])) continue;
    const double passed = start ? log.t[i] - log.t[*start] : 0.0;
    if (start && passed < kWindow) continue;
    const bool turning = start && turn(log, *start, i) > kTurning * passed;
    if (start && passed < 0.2 && rates > 0)
      if (const double by = rate_sum / static_cast<double>(rates) * passed; kDegrees * by < 1.0)
        squares.push_back({by * by, std::pow(turn(log, *start, i), 2)});
    if (turning && passed < 0.2 && rates > 0) {
      by_attitude += turn(log, *start, i);
      by_rates += rate_sum / static_cast<double>(rates) * passed;
    }
    start = i;
    rate_sum = 0.0, rates = 0;
  }
  const double ratio = by_attitude > 0.0 ? by_rates / by_attitude : 1.0;
  const bool enough = by_attitude > 0.5;  // rad in all
  if (enough && ratio > 0.6 * kDegrees && ratio < 1.7 * kDegrees)
    throw InputError(
        log.file, header_line, "p, q, r",
        fmt::format("are {:.3g} times faster than the attitude turns: they are in deg/s; name the unit in "
                    "the header, as in 'p [deg/s]'",
                    ratio));
  const bool with_rates = turns_with_rates(squares) > 0.3 * kDegrees;
  if (!enough || !with_rates || !(ratio * kDegrees > 0.6 && ratio * kDegrees < 1.7)) return;
  if (quaternions)
    throw InputError(
        log.file, header_line, "p, q, r",
        fmt::format("are {:.3g} times slower than the attitude turns: they are in rad/s and not in "
                    "deg/s, as the header or the map says",
                    1.0 / ratio));
  throw InputError(
      log.file, header_line, "phi, theta, psi",
      fmt::format("turn {:.3g} times faster than the rates say: they are in degrees; name the unit in "
                  "the header, as in 'phi [deg]'",
                  1.0 / ratio));
}

void check_velocity_axes(const FlightLog& log, long header_line, const Eigen::Matrix3d& to_body) {
  if (!log.has_velocity() || !log.has_position() || !log.has_attitude()) return;
  constexpr double kLeast = 0.5, kMostMotion = 1.5;  // s over which a position is compared
  constexpr double kFar = 3.0, kShare = 0.1;         // m in all, and of its square what the right axes leave
  Eigen::Vector3d by_world = Eigen::Vector3d::Zero(), by_body = by_world, x0 = by_world;
  double path = 0, left_world = 0, left_body = 0;
  std::optional<std::size_t> start, last;
  for (std::size_t i = 0; i < log.rows(); ++i) {
    const Eigen::Vector3d x(log.x_W[0][i], log.x_W[1][i], log.x_W[2][i]),
        v(log.v_W[0][i], log.v_W[1][i], log.v_W[2][i]);
    const Eigen::Quaterniond q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    if (!x.allFinite() || !v.allFinite() || !std::isfinite(q.w())) continue;
    if (last)
      by_world += (log.t[i] - log.t[*last]) * v, by_body += (log.t[i] - log.t[*last]) * (q * (to_body * v));
    last = i;
    const double passed = start ? log.t[i] - log.t[*start] : 0.0;
    if (start && passed < kLeast) continue;
    if (start && passed < kMostMotion) {
      path += (x - x0).norm();
      left_world += (x - x0 - by_world).squaredNorm(), left_body += (x - x0 - by_body).squaredNorm();
    }
    start = i, x0 = x, by_world.setZero(), by_body.setZero();
  }
  if (path > kFar && left_body < kShare * left_world)
    throw InputError(
        log.file, header_line, "vx, vy, vz",
        "are along the axes of the body, as position and attitude say: give velocities along those "
        "of the world, or leave them out");
}

}  // namespace ident
