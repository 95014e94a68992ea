// Every log is left out in turn; a step far beyond both the deviations and any scatter of real flights speaks
// of another vehicle.
#include "ident/flight/checks/logs_consistent.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>

#include "ident/flight/fit/fit_steps.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLogsBeyondChance = 10.0;  // standard deviations
constexpr double kAnotherVehicle = 0.2;     // of the value: flights of one vehicle scatter by less
constexpr double kToldByLogs = 0.1;         // deviation of a constant that the other logs tell by themselves
constexpr std::size_t kFew = 2;             // constants; a worn battery moves one

// Thrust, which every vehicle has another of for its weight; an effect that the model lacks rarely moves it
// along with others.
bool is_of_thrust(int index) { return index == param::kT || index == param::m || index == param::km; }

struct WithoutLog {
  std::vector<std::string> moved;  // constants that would be another vehicle's
  bool beyond_doubt = false;       // the other logs tell such by themselves, and one of them is of thrust
  double from_stated = 0.0;        // cost of the priors there
};

WithoutLog without(const FlightRecord& record, const Theta& theta, const FlightFit& fit, int log) {
  const PriorTerms prior = theta.prior(fit.u);
  MatrixXd H = prior_information(theta, fit.u);
  VectorXd g = prior.gradient();
  for (const ScoreBlock& block : fit.blocks)
    if (record.arcs[static_cast<std::size_t>(block.arc)].log != log) H += block.information, g += block.score;
  const MatrixXd covariance = inverse_of(H);
  const VectorXd step = -covariance * g;
  WithoutLog out;
  std::size_t told = 0;
  bool thrust = false;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    const double std = std::sqrt(std::max(covariance(i, i), fit.covariance(i, i)));
    if (!c.positive || !(std::abs(step[i]) > std::max(kLogsBeyondChance * std, kAnotherVehicle))) continue;
    out.moved.push_back(c.name);
    if (!(std::sqrt(covariance(i, i)) < kToldByLogs)) continue;
    told += 1, thrust |= is_of_thrust(c.index);
  }
  out.beyond_doubt = told >= kFew && thrust;
  out.from_stated = prior.cost_after(step);
  return out;
}

}  // namespace

std::vector<Warning> logs_agree(const FlightRecord& record, std::span<const FlightLog> logs,
                                const Theta& theta, const FlightFit& fit) {
  if (record.logs < 2 || fit.blocks.empty()) return {};
  std::vector<std::string> moved;
  bool beyond_doubt = false;
  int odd = -1;
  double least = 0.0;
  for (int log = 0; log < record.logs; ++log) {
    const WithoutLog rest = without(record, theta, fit, log);
    beyond_doubt |= rest.beyond_doubt;
    if (rest.moved.size() < kFew || (odd >= 0 && rest.from_stated > least)) continue;
    odd = log, least = rest.from_stated, moved = rest.moved;
  }
  if (!beyond_doubt) return {};
  return {{"logs_disagree",
           fmt::format("{} does not fly like the others: without it {} would differ by 20 % or more. It is "
                       "of another vehicle, or the vehicle was changed in between. Refine it by itself",
                       logs[static_cast<std::size_t>(odd)].file, fmt::join(moved, ", "))}};
}

}  // namespace ident
