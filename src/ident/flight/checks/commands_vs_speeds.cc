// Regression of each speed on a command that passed several motors and dead times: any linear motor is near a
// mixture of these.
#include "ident/flight/checks/commands_vs_speeds.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/model/motor.h"

namespace ident {
namespace {

constexpr std::array kOmega = {5.0, 10.0, 20.0, 40.0, 80.0};  // rad/s
constexpr double kZeta = 0.8;
constexpr std::array kDeadTimes = {0.0, 0.04, 0.1, 0.2};  // s
// Share of the variance within short stretches, beyond noise, that is explained: by right commands 0.90 and
// more of seventy simulated flights, by the sign of these alone up to 0.70. What a battery does is slower.
constexpr double kFollows = 0.8;
constexpr double kStretch = 3.0;  // s
// A speed that changes there by fewer of its own noise, or by a smaller share of its mean, tells nothing.
constexpr double kChanges = 5.0, kOfMean = 0.01;
constexpr double kFlies = 0.3;  // of the median speed: slower ones are of the ground
constexpr std::size_t kLeast = 200;

struct Speed {
  std::vector<std::size_t> rows;  // that brought a new value in flight
  Eigen::VectorXd Omega;          // there, without the means of stretches
  double noise = 0.0;             // its variance
};

bool is_used(const FlightLog& log, double t) {
  return log.windows.empty() ||
         std::ranges::any_of(log.windows, [&](const auto& w) { return t >= w[0] && t <= w[1]; });
}

// Takes the mean of each short stretch off a column.
void take_means_off(const FlightLog& log, const std::vector<std::size_t>& rows,
                    Eigen::Ref<Eigen::VectorXd> x) {
  for (std::size_t from = 0, to = 0; from < rows.size(); from = to) {
    while (to < rows.size() && log.t[rows[to]] - log.t[rows[from]] <= kStretch) ++to;
    auto part = x.segment(static_cast<Eigen::Index>(from), static_cast<Eigen::Index>(to - from));
    part.array() -= part.mean();
  }
}

// The samples of a rotor's speed in flight; none where they tell nothing. Speeds that are held between
// samples count once.
std::optional<Speed> telling(const FlightLog& log, const std::vector<double>& column) {
  std::vector<double> turning;
  std::ranges::copy_if(column, std::back_inserter(turning), [](double x) { return x > 0; });
  if (turning.size() < kLeast) return {};
  const double slowest = kFlies * median(turning);
  Speed speed;
  std::vector<double> Omega;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const bool anew = Omega.empty() || column[i] != Omega.back();
    if (column[i] > slowest && anew && is_used(log, log.t[i]))
      speed.rows.push_back(i), Omega.push_back(column[i]);
  }
  if (speed.rows.size() < kLeast) return {};
  std::vector<double> changes;
  for (std::size_t i = 1; i < Omega.size(); ++i) changes.push_back(Omega[i] - Omega[i - 1]);
  const double noise = mad_scale(changes, 0.0) / std::sqrt(2.0);
  speed.noise = noise * noise;
  speed.Omega = Eigen::Map<const Eigen::VectorXd>(Omega.data(), std::ssize(Omega));
  take_means_off(log, speed.rows, speed.Omega);
  const double spread = std::sqrt(speed.Omega.squaredNorm() / static_cast<double>(Omega.size()));
  if (!(spread > kChanges * noise) || !(spread > kOfMean * mean(Omega))) return {};
  return speed;
}

// A column of commands after a dead time and a motor; rows without a command hold the last one, those before
// any the first.
std::vector<double> passed(const std::vector<double>& t, const std::vector<double>& delta, double dead_time,
                           double omega_m) {
  const auto first = std::ranges::find_if(delta, [](double x) { return std::isfinite(x); });
  std::vector<double> out(t.size(), 0.0);
  if (first == delta.end()) return out;
  MotorState<double> y{*first, 0.0};
  MotorTransition<double> motor{};
  double command = *first, h = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i > 0) {
      const double step = t[i] - t[i - 1];
      if (std::abs(step - h) > 1e-3 * h) h = step, motor = motor_transition(omega_m, kZeta, h);
      y = motor(y, command);
    }
    for (; next <= i && t[next] <= t[i] - dead_time; ++next)
      if (std::isfinite(delta[next])) command = delta[next];
    out[i] = y.Omega;
  }
  return out;
}

bool follows(const FlightLog& log, const Speed& speed, const std::vector<double>& delta) {
  Eigen::MatrixXd by(speed.Omega.size(), std::ssize(kOmega) * std::ssize(kDeadTimes));
  Eigen::Index column = 0;
  for (const double omega_m : kOmega)
    for (const double dead_time : kDeadTimes) {
      const std::vector<double> one = passed(log.t, delta, dead_time, omega_m);
      for (std::size_t k = 0; k < speed.rows.size(); ++k)
        by(static_cast<Eigen::Index>(k), column) = one[speed.rows[k]];
      take_means_off(log, speed.rows, by.col(column++));
    }
  constexpr double kRounding = 1e-9;
  const Eigen::VectorXd told = by.transpose() * speed.Omega;
  Eigen::MatrixXd S = by.transpose() * by;
  S.diagonal().array() += kRounding * S.trace() + 1e-300;
  const Eigen::VectorXd gain = Eigen::LDLT<Eigen::MatrixXd>(S).solve(told);
  const double explained = told.dot(gain), noise = speed.noise * static_cast<double>(speed.rows.size());
  return gain.sum() > 0 && explained > kFollows * (speed.Omega.squaredNorm() - noise);
}

}  // namespace

bool commands_contradict_speeds(const FlightLog& log) {
  bool told = false;
  for (std::size_t n = 0; n < log.Omega.size(); ++n) {
    const std::optional<Speed> speed = telling(log, log.Omega[n]);
    if (!speed) continue;
    for (std::size_t i = 0; i < log.delta.size(); ++i)  // its own first
      if (follows(log, *speed, log.delta[(n + i) % log.delta.size()])) return false;
    told = true;
  }
  return told && log.has_commands();
}

}  // namespace ident
