// Intervals, pulls and identifiability from the covariance of the unknowns and the priors.
#include "ident/flight/fit/fitted_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/fit/fit_steps.h"

namespace ident {
namespace {

using Eigen::VectorXd;

// What "identifiable" means (notebooks/guide/formats.md): a standard deviation below this share of the
// prior's, or, without a prior, of the value.
constexpr double kShareOfPrior = 0.5, kShareOfValue = 0.1;
constexpr double kMoved = 1e-6;       // of the standard deviation of the prior
constexpr double kContradicts = 3.0;  // standard deviations of a pull: p = 0.003
constexpr double kHeard = 0.05;       // least share of information from flight for a pull to mean anything
constexpr double kTogether = 0.1;     // least correlation of priors that are named together

// Pulls against correlated priors, in standard deviations: how much each prior, given the others, is
// contradicted. With covariance C and precision P of the priors in standard deviations, the naive covariance
// S of the fit and the corrected one V, the estimate moves by d with covariance C - 2 S + V (C - S for white
// residuals); P d is the pull times its standard deviation. 0 where the flight adds nothing.
VectorXd pulls_together(const PriorTerms& prior, const FlightFit& fit) {
  const Eigen::MatrixXd& P = prior.precision;
  const auto scaled = [&](const Eigen::MatrixXd& covariance) {
    return Eigen::MatrixXd(prior.slope.asDiagonal() * covariance * prior.slope.asDiagonal());
  };
  const Eigen::MatrixXd spread = scaled(fit.covariance) - 2 * scaled(fit.naive_covariance);
  const VectorXd variance = P.diagonal() + (P * spread * P).diagonal(), against = P * prior.residual;
  VectorXd pulls = VectorXd::Zero(variance.size());
  for (Eigen::Index i = 0; i < pulls.size(); ++i)
    if (variance[i] > kHeard * P(i, i)) pulls[i] = against[i] / std::sqrt(variance[i]);
  return pulls;
}

// A constant that the bench knows well is no open question where flight adds nothing to it.
std::string why_not(const Parameter& p) {
  if (!p.prior_std) return "these logs do not determine it";
  if (std::abs(*p.pull) > kContradicts)
    return "these logs contradict what was known, and do not determine it";
  const bool known = *p.prior_std < kShareOfValue * std::abs(*p.prior_value);
  return known ? "known from what was stated, these logs add little"
               : "these logs say little beyond what was known";
}

}  // namespace

std::vector<Parameter> flight_parameters(const Theta& theta, const FlightFit& fit,
                                         const std::string& source) {
  std::vector<Parameter> out;
  const VectorXd pulls = pulls_together(theta.prior(fit.u), fit);
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (c.watched) continue;
    Parameter p;
    p.name = c.name;
    p.value = theta.physical(fit.u, i);
    p.std = theta.deviation(fit.u, i, fit.covariance);
    p.naive_std = theta.deviation(fit.u, i, fit.naive_covariance);
    p.unit = parameter_unit(c.name);
    p.source = source;
    // For positive constants by the logarithm, so that the interval stays positive.
    const double z = 1.96 * std::sqrt(fit.covariance(i, i));
    p.ci95 = c.positive && z < 3 && !c.prior_std ? std::array{p.value * std::exp(-z), p.value * std::exp(z)}
                                                 : std::array{p.value - 1.96 * p.std, p.value + 1.96 * p.std};
    if (c.prior_std) {
      p.prior_value = c.prior_value, p.prior_std = *c.prior_std;
      const double ratio = std::min(*p.naive_std / *c.prior_std, 1.0);
      p.from_flight = 1 - ratio * ratio;
      // The pull compares two sources of information: the flight alone (naive variance v, in truth `colour`
      // times that) and the prior. The estimate moves by a share of their difference.
      const double stated = *c.prior_std * *c.prior_std, share = std::max(1 - ratio * ratio, 1e-4);
      const double alone = stated * (1 - share) / share, colour = std::pow(p.std / *p.naive_std, 2);
      p.pull = c.known_with.empty() ? (p.value - c.prior_value) / (share * std::sqrt(stated + colour * alone))
                                    : pulls[i];
      p.known_together = !c.known_with.empty();
      p.identifiable = p.std < kShareOfPrior * *c.prior_std;
    } else {
      p.from_flight = 1.0;
      // What is zero for most vehicles is judged against its usual size.
      const bool mostly_zero = c.index == param::dead_time || c.index == param::Omega_0;
      p.identifiable = p.std < kShareOfValue * std::max(std::abs(p.value), mostly_zero ? c.scale : 0.0);
    }
    const bool told = c.prior_std ? std::abs(p.value - c.prior_value) > kMoved * *c.prior_std
                                  : p.std < std::abs(p.value) && c.name.find('.') == std::string::npos;
    p.joint = !p.identifiable && told;
    if (!p.identifiable) p.note = why_not(p);
    out.push_back(p);
  }
  return out;
}

Correlation flight_correlation(const Theta& theta, const Eigen::VectorXd& u,
                               const Eigen::MatrixXd& covariance) {
  Correlation out;
  std::vector<Eigen::Index> at;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
    if (!c.watched) out.names.push_back(c.name), at.push_back(i);
  }
  const auto n = theta.constants_count();
  const Eigen::MatrixXd J = theta.slopes(u), of_values = J * covariance.topLeftCorner(n, n) * J.transpose();
  const VectorXd s = of_values.diagonal()(at).cwiseSqrt().cwiseInverse();
  out.matrix = s.asDiagonal() * of_values(at, at) * s.asDiagonal();
  return out;
}

std::vector<std::string> combinations(const Theta& theta, const FlightFit& fit,
                                      const std::vector<Parameter>& parameters) {
  std::vector<std::string> out;
  const auto usable = [&](std::size_t i) {
    return theta.constants()[i].positive && !parameters[i].identifiable;
  };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (i == k || !usable(i) || !usable(k)) continue;
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(k);
      const double vi = fit.covariance(a, a), vk = fit.covariance(b, b), c = fit.covariance(a, b);
      // The variance of log(x_i) + e log(x_k) is least for e = -c/vk; a simple exponent that leaves little of
      // it is a finding.
      for (const double e : {1.0, 2.0, -1.0, -2.0}) {
        const double v = vi + 2 * e * c + e * e * vk;
        if (v > 0.04 * std::min(vi, e * e * vk) || (std::abs(e) == 1.0 && i > k)) continue;
        const std::string power = std::abs(e) == 2 ? "^2" : "";
        const std::string both = e > 0 ? parameters[i].name + " " + parameters[k].name + power
                                       : parameters[i].name + "/" + parameters[k].name + power;
        out.push_back(fmt::format("{} and {} only as {}", parameters[i].name, parameters[k].name, both));
      }
    }
  }
  return out;
}

bool disagrees(const Parameter& p) {
  const bool heard = p.known_together || (p.from_flight && *p.from_flight > kHeard);
  return p.pull && heard && std::abs(*p.pull) > 3;
}

void warn_of_disagreement(Result& result, std::string_view advice) {
  for (const Parameter& p : result.parameters) {
    if (!disagrees(p)) continue;
    std::string others;
    for (const std::string& other : result.prior_correlation.names)
      if (other != p.name && std::abs(result.prior_correlation.of(p.name, other)) > kTogether)
        others += (others.empty() ? ", together with " : ", ") + other;
    if (!others.empty()) others += ",";
    result.warn("prior_disagrees",
                fmt::format("{}: flight says {}, the value given beforehand{} was {} ({:+.1f} standard "
                            "deviations): one of the two is wrong, or {}",
                            p.name, format_with_uncertainty(p.value, p.std), others,
                            format_with_uncertainty(*p.prior_value, *p.prior_std), *p.pull, advice));
  }
}

}  // namespace ident
