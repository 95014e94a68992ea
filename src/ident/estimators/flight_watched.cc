// Omega_0 and dead_time beside the constants of a fit.
#include "ident/estimators/flight_watched.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/estimators/flight_steady_push.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHeld = 1e-6;  // of the unit step: a tenth of the speed at hover, 5 ms
constexpr std::ptrdiff_t kFewBlocks = 8;
constexpr double kBeyondDoubt = 25.0;  // fall of the cost: five standard deviations
constexpr double kMatters = 1e-3;      // of the unit step: less is rounding
const std::string kOffset = "Omega_0", kDeadTime = "dead_time";

// How often beyond chance, in squared standard deviations, the logs contradict the watched constant `at`.
double contradiction(const Theta& theta, const FlightFit& fit, Eigen::Index at) {
  // What it gains when it is free, over the factor by which coloured residuals spread the scores it leaves.
  PriorTerms prior = theta.prior(fit.u);
  prior.slope[at] = 0;
  const Eigen::Index n = fit.u.size();
  MatrixXd F = MatrixXd::Zero(n, n), H = prior.slope.cwiseAbs2().asDiagonal();
  VectorXd g = prior.slope.cwiseProduct(prior.residual);
  for (const ScoreBlock& block : fit.blocks) F += block.information, g += block.score;
  H += F;
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  scaled.diagonal().array() += 1e-12;
  const Eigen::LDLT<MatrixXd> solver(scaled);
  const auto solved = [&](const VectorXd& x) {
    return VectorXd(s.asDiagonal() * solver.solve(s.asDiagonal() * x));
  };
  const VectorXd direction = solved(VectorXd::Unit(n, at)), step = -solved(g);
  if (!(std::abs(step[at]) > kMatters)) return 0;
  double spread = 0;
  for (const ScoreBlock& block : fit.blocks)
    spread += std::pow(direction.dot(block.score + block.information * step), 2);
  return g.dot(solved(g)) / std::max(spread / direction.dot(F * direction), 1.0);
}

// The unknowns of one fit as those of another with the same logs; constants that are new there stand at 0.
VectorXd carried(const FittedFlight& one, const Theta& to) {
  VectorXd u = VectorXd::Zero(to.size());
  const int from = one.theta->constants_count(), count = to.constants_count();
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < from; ++k)
      if (to.name(i) == one.theta->name(k)) u[i] = one.fit.u[k];
  u.tail(to.size() - count) = one.fit.u.tail(one.theta->size() - from);
  return u;
}

void warn(Result& result, const std::string& name) {
  if (name == kOffset)
    result.warn("command_offset",
                "the rotors' speed is not proportional to the command, or the mass or kT as stated is wrong: "
                "Omega_0, "
                "their speed at command 0 as the line through the flown commands gives it, is estimated too");
  else
    result.warn(
        "dead_time",
        "the rotors do not follow their commands as motors without a dead time would, and the vehicle "
        "file states none: dead_time is estimated too");
}

}  // namespace

void watch(const std::vector<std::string>& names, std::vector<FreeConstant>& constants,
           const Vehicle& vehicle, const FlightRecord& record, const std::vector<double>& p) {
  if (!record.signals.commands) return;
  for (const std::string& name : names) {
    const auto is_it = [&](const FreeConstant& c) { return c.name == name; };
    if (vehicle.has(name) || std::ranges::any_of(constants, is_it)) continue;
    const std::vector<FreeConstant> all = free_constants(vehicle, p, {name});
    FreeConstant held = *std::ranges::find_if(all, is_it);
    held.watched = true;
    held.prior_value = held.start, held.prior_std = kHeld * held.scale;
    constants.push_back(held);
  }
}

std::optional<std::string> contradicted(const Theta& theta, const FlightFit& fit) {
  if (std::ssize(fit.blocks) < kFewBlocks) return {};
  std::optional<std::string> found;
  double most = kBeyondDoubt;
  for (Eigen::Index at = 0; at < theta.constants_count(); ++at) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(at)];
    if (!c.watched) continue;
    const double beyond = contradiction(theta, fit, at);
    if (beyond > most) most = beyond, found = c.name;
  }
  return found;
}

FittedFlight fit_and_watch(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
                           std::vector<FreeConstant> constants, const WatchOptions& options, Result& result) {
  FlightFitOptions fit_options;
  fit_options.progress = options.progress;
  fit_options.steps = Steps::longest;  // on the way to its exact end
  const auto theta_of = [&](std::vector<FreeConstant> of) {
    return std::make_unique<Theta>(p, std::move(of), record.logs, record.signals.rates);
  };
  watch(options.watched, constants, vehicle, record, p);
  FittedFlight one{theta_of(std::move(constants)), {}};
  one.fit = fit_flight(record, *one.theta, fit_options);
  std::vector<std::string> also = options.also;
  while (const auto name = contradicted(*one.theta, one.fit)) {
    also.push_back(*name);
    warn(result, *name);
    std::vector<FreeConstant> more = free_constants(vehicle, p, also);
    watch(options.watched, more, vehicle, record, p);
    FittedFlight other{theta_of(std::move(more)), {}};
    fit_options.start = carried(one, *other.theta), fit_options.noise = one.fit.noise;
    fit_options.noise->axes = GustAxes::world;
    other.fit = fit_flight(record, *other.theta, fit_options);
    one = std::move(other);
  }
  const auto is_watched = [](const FreeConstant& c) { return c.watched && c.name == kOffset; };
  if (std::ranges::none_of(one.theta->constants(), is_watched)) return one;
  // What stays for the whole flight passes for a gust once noise is that strong.
  if (!steady_push(record, one.fit).matters(vehicle.g)) return one;
  also.push_back(kOffset);
  FittedFlight other{theta_of(free_constants(vehicle, p, also)), {}};
  fit_options.start = {}, fit_options.noise.reset();  // anew: that noise would hide it again
  try {
    other.fit = fit_flight(record, *other.theta, fit_options);
  } catch (const DataError&) {  // nothing flies with it
    return one;
  }
  const bool likelier = other.fit.smoother->surprise() < one.fit.smoother->surprise() - kBeyondDoubt;
  if (!likelier || steady_push(record, other.fit).matters(vehicle.g)) return one;
  warn(result, kOffset);
  return other;
}

}  // namespace ident
