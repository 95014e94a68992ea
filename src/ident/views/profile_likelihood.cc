// Walks along one constant at a time; the smoother's linearisations give the likelihood of the rest.
#include "ident/views/profile_likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "ident/core/format_number.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kKnownTogether = 0.95;  // correlation
// Undetermined constants have deviations of many factors of e: further than this no flight is simulated.
constexpr double kFurthest = 0.5;
constexpr double kMuchToGain = 0.3;  // of twice the log likelihood, for which a further evaluation is made

double cost_with_priors(const ReducedSystem& system, const Theta& theta, const VectorXd& u) {
  return system.cost + theta.prior(u).cost();
}

// The best of all others near u, with `held` where it is.
VectorXd newton_step(const ReducedSystem& system, const Theta& theta, const VectorXd& u, Index held) {
  const PriorTerms prior = theta.prior(u);
  MatrixXd H = system.S + prior.information();
  for (Index i = 0; i < u.size(); ++i)
    if (prior.slope[i] == 0) H(i, i) += 1e-2;
  VectorXd g = system.g + prior.gradient();
  H.row(held).setZero(), H.col(held).setZero();
  H(held, held) = 1, g[held] = 0;
  const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
  return u - s.asDiagonal() * Eigen::LDLT<MatrixXd>(scaled).solve(s.asDiagonal() * g);
}

// The linearisation at `start` says how much the others can still gain; where that is much, it is looked at.
double profiled_cost(FlightSmoother& smoother, const Theta& theta, const VectorXd& start, Index held) {
  const ReducedSystem first = smoother.linearize(start);
  if (!std::isfinite(first.cost) || !first.S.allFinite()) return kNaN;
  const VectorXd better = newton_step(first, theta, start, held), step = better - start;
  const double at_start = cost_with_priors(first, theta, start);
  const double promised =
      first.cost + 2 * first.g.dot(step) + step.dot(first.S * step) + theta.prior(better).cost();
  if (at_start - promised < kMuchToGain) return promised;
  const ReducedSystem second = smoother.linearize(better);
  return std::isfinite(second.cost) ? std::min(at_start, cost_with_priors(second, theta, better)) : at_start;
}

Plot profile_plot(const Profile& profile, const Parameter& parameter) {
  const std::string unit = parameter.unit.empty() ? "-" : parameter.unit;
  Plot plot{
      .id = "profile-" + parameter.name,
      .title = "Profile likelihood of " + parameter.name,
      .caption =
          "Dots: all other constants fitted anew. On the line where the interval of the table is "
          "right; the 95 % interval ends at 3.84.",
      .x_label = parameter.name + " [" + unit + "]",
      .y_label = "2 log likelihood ratio [-]",
      .series = {{.name = "from the curvature", .x = profile.along, .y = profile.parabola},
                 {.name = "evaluated", .x = profile.value, .y = profile.fall, .style = Series::Style::points},
                 {.name = "95 %",
                  .x = {profile.along.front(), profile.along.back()},
                  .y = {3.84, 3.84},
                  .style = Series::Style::measured}}};
  if (parameter.prior_std)
    plot.series.push_back({.name = "prior alone", .x = profile.along, .y = profile.prior});
  return plot;
}

}  // namespace

std::vector<int> weak_constants(const FlightFit& fit, const std::vector<Parameter>& parameters) {
  std::vector<std::pair<double, int>> weak;
  const auto deviation = [&](Index i) { return std::sqrt(fit.covariance(i, i)); };
  for (Index i = 0; i < static_cast<Index>(parameters.size()); ++i) {
    const Parameter& p = parameters[static_cast<std::size_t>(i)];
    bool together = false;
    for (Index k = 0; k < static_cast<Index>(parameters.size()); ++k)
      together = together ||
                 (k != i && std::abs(fit.covariance(i, k)) > kKnownTogether * deviation(i) * deviation(k));
    if (p.identifiable && !together) continue;
    const double known = p.prior_std ? *p.prior_std : std::abs(p.value);
    weak.emplace_back(-p.std / std::max(known, 1e-300), static_cast<int>(i));
  }
  std::ranges::sort(weak);
  std::vector<int> out;
  out.reserve(weak.size());
  for (const auto& [rank, i] : weak) out.push_back(i);
  return out;
}

Profile profile_of(FlightSmoother& smoother, const FlightFit& fit, const Theta& theta, int constant) {
  const Index i = constant;
  Profile out{.constant = constant};
  const double naive = std::sqrt(fit.naive_covariance(i, i)),
               colour = std::sqrt(fit.covariance(i, i)) / naive;
  const bool positive = theta.constants()[static_cast<std::size_t>(constant)].positive;
  const double step = positive ? std::min(naive * colour, kFurthest) : naive * colour;
  const VectorXd along = fit.naive_covariance.col(i) / fit.naive_covariance(i, i);
  const double best = cost_with_priors(smoother.linearize(fit.u), theta, fit.u);
  const double own = theta.prior(fit.u).residual[i];
  for (int k = -3; k <= 3; ++k) {
    const VectorXd u = fit.u + along * (k * step);
    const double cost = k == 0 ? best : profiled_cost(smoother, theta, u, i);
    out.value.push_back(theta.physical(u, constant));
    out.fall.push_back((cost - best) / (colour * colour));
  }
  for (double k = -3.3; k < 3.35; k += 0.1) {
    const VectorXd u = fit.u + along * (k * step);
    const double there = theta.prior(u).residual[i];
    out.along.push_back(theta.physical(u, constant));
    out.parabola.push_back(std::pow(k * step / (naive * colour), 2));
    out.prior.push_back((there * there - own * own) / (colour * colour));
  }
  return out;
}

std::vector<Section> profile_sections(const FlightFit& fit, const Theta& theta,
                                      const std::vector<Parameter>& parameters, std::size_t most,
                                      const std::function<void(double)>& progress) {
  std::vector<int> weak = weak_constants(fit, parameters);
  if (weak.empty()) return {};
  const std::size_t all = weak.size();
  weak.resize(std::min(most, all));
  Section section{.title = "Profile likelihood of weak parameters",
                  .text =
                      "Each is held at 1, 2 and 3 standard deviations from its estimate; the others are "
                      "fitted anew there by one Newton step of the whole flight, noise levels as found."};
  if (all > weak.size())
    section.text +=
        " Shown are the " + std::to_string(weak.size()) + " weakest of " + std::to_string(all) + ".";
  for (std::size_t k = 0; k < weak.size(); ++k) {
    const Profile profile = profile_of(*fit.smoother, fit, theta, weak[k]);
    section.plots.push_back(profile_plot(profile, parameters[static_cast<std::size_t>(weak[k])]));
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(weak.size()));
  }
  return {section};
}

}  // namespace ident
