// A prior of one loop for the dead time.
#include "ident/flight/fit/loop_timing.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

// Usual time between samples of a column, s; 0 where there are none.
double apart(const std::vector<double>& t, const std::vector<double>& column) {
  std::vector<double> steps;
  double last = kNaN;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!std::isfinite(column[i])) continue;
    if (std::isfinite(last)) steps.push_back(t[i] - last);
    last = t[i];
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

}  // namespace

double loop_of(std::span<const FlightLog> logs) {
  double longest = 0;
  for (const FlightLog& log : logs) {
    if (!(log.loop > 0) || !log.each_command) return 0;
    longest = std::max(longest, log.loop);
  }
  return longest;
}

bool commands_are_skipped(std::span<const FlightLog> logs) {
  return std::ranges::any_of(logs, [](const FlightLog& log) { return log.loop > 0 && !log.each_command; });
}

void leave_loop_open(std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                     const std::vector<double>& p, std::span<const FlightLog> logs) {
  const double loop = loop_of(logs);
  if (!(loop > 0)) return;
  const auto is_it = [](const FreeConstant& c) { return c.index == param::dead_time; };
  auto at = std::ranges::find_if(constants, is_it);
  if (at == constants.end()) {
    if (vehicle.has("dead_time") && vehicle.parameters.at("dead_time").std == 0.0) return;
    std::vector<FreeConstant> all = free_constants(vehicle, p, {"dead_time"});
    at = constants.insert(constants.end(), *std::ranges::find_if(all, is_it));
    at->prior_value = p[param::dead_time];
  } else if (!at->prior_std) {
    return;  // asked for, and nothing is known of it
  }
  at->prior_std = std::hypot(at->prior_std.value_or(0.0), loop);
}

Eigen::VectorXd moved_by_smoothing(std::span<const FlightLog> logs, const Theta& theta,
                                   const FlightFit& fit) {
  Eigen::VectorXd du = Eigen::VectorXd::Zero(fit.u.size());
  const bool skipped = commands_are_skipped(logs);
  if (!(loop_of(logs) > 0) && !skipped) return du;
  double T = 0;
  for (const FlightLog& log : logs)
    T = std::max({T, apart(log.t, log.w_B[0]), log.has_rotor_speeds() ? apart(log.t, log.Omega[0]) : 0.0,
                  skipped && log.has_commands() ? apart(log.t, log.delta[0]) : 0.0});
  const std::vector<double> p = theta.p(fit.u);
  const double share = std::pow(p[param::omega_m] * T, 2) / 48;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const int index = theta.constants()[static_cast<std::size_t>(i)].index;
    if (index == param::omega_m || index == param::zeta_m)
      du[i] = share * p[static_cast<std::size_t>(index)] / theta.slope(fit.u, i);
  }
  return du;
}

}  // namespace ident
