// Omega_0 beside the constants of a fit.
#include "ident/estimators/flight_command_offset.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/estimators/flight_steady_push.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHeld = 1e-6;  // of the unit step, a tenth of the speed at hover
constexpr std::ptrdiff_t kFewBlocks = 8;
constexpr double kBeyondDoubt = 25.0;  // fall of the cost: five standard deviations
constexpr double kMatters = 1e-3;      // of the unit step: less is rounding

}  // namespace

void watch_command_offset(std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                          const FlightRecord& record, const std::vector<double>& p) {
  const auto is_offset = [](const FreeConstant& c) { return c.index == param::Omega_0; };
  if (!record.signals.commands || vehicle.has("Omega_0") || std::ranges::any_of(constants, is_offset)) return;
  const std::vector<FreeConstant> all = free_constants(vehicle, p, {"Omega_0"});
  FreeConstant offset = *std::ranges::find_if(all, is_offset);
  offset.watched = true;
  offset.prior_value = offset.start, offset.prior_std = kHeld * offset.scale;
  constants.push_back(offset);
}

bool shows_command_offset(const Theta& theta, const FlightFit& fit) {
  const auto watched = std::ranges::find_if(theta.constants(), &FreeConstant::watched);
  if (watched == theta.constants().end() || std::ssize(fit.blocks) < kFewBlocks) return false;
  const auto at = watched - theta.constants().begin();
  // What the offset gains, over the factor by which coloured residuals spread the scores that it leaves.
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
  const VectorXd direction = solved(VectorXd::Unit(n, at));
  double spread = 0;
  const VectorXd step = -solved(g);
  for (const ScoreBlock& block : fit.blocks)
    spread += std::pow(direction.dot(block.score + block.information * step), 2);
  const double stretch = std::max(spread / direction.dot(F * direction), 1.0);
  return g.dot(solved(g)) > kBeyondDoubt * stretch && std::abs(step[at]) > kMatters;
}

FittedFlight fit_with_offset_if_asked(const Vehicle& vehicle, const std::vector<double>& p,
                                      const FlightRecord& record, std::vector<FreeConstant> constants,
                                      const OffsetOptions& options, Result& result) {
  FlightFitOptions fit_options;
  fit_options.progress = options.progress;
  fit_options.steps = Steps::longest;  // on the way to its exact end
  if (options.ask) watch_command_offset(constants, vehicle, record, p);
  const bool watched = std::ranges::any_of(constants, &FreeConstant::watched);
  const auto theta_of = [&](std::vector<FreeConstant> of) {
    return std::make_unique<Theta>(p, std::move(of), record.logs, record.signals.rates);
  };
  FittedFlight one{theta_of(std::move(constants)), {}};
  one.fit = fit_flight(record, *one.theta, fit_options);
  const bool seen = shows_command_offset(*one.theta, one.fit);
  // What stays for the whole flight passes for a gust once noise is that strong.
  if (!seen && !(watched && steady_push(record, one.fit).matters(vehicle.g))) return one;
  std::vector<std::string> also = options.also;
  also.emplace_back("Omega_0");
  FittedFlight other{theta_of(free_constants(vehicle, p, also)), {}};
  if (seen) {  // the offset stands last here as it did while it was watched: from where that fit ended
    fit_options.start = one.fit.u, fit_options.noise = one.fit.noise;
    fit_options.noise->axes = GustAxes::world;
  }  // else anew: that noise would hide it again
  try {
    other.fit = fit_flight(record, *other.theta, fit_options);
  } catch (const DataError&) {  // nothing flies with it
    if (seen) throw;
    return one;
  }
  const bool likelier = other.fit.smoother->surprise() < one.fit.smoother->surprise() - kBeyondDoubt;
  if (!seen && !(likelier && !steady_push(record, other.fit).matters(vehicle.g))) return one;
  result.warn(
      "command_offset",
      "the rotors' speed is not proportional to the command, or the mass or kT as stated is wrong: Omega_0, "
      "their speed at command 0 as the line through the flown commands gives it, is estimated too");
  return other;
}

}  // namespace ident
