// Wald's test of the linear term, and how much of full scale the law misses.
#include "ident/estimators/thrust_sweep_law.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/estimators/statistics.h"

namespace ident {
namespace {

constexpr double kSignificant = 0.01;
constexpr double kMaterial = 0.5;  // % of full scale that the linear term takes away from the misfit

/// Probability of terms as large as these when their true values are zero.
double wald_p(const LeastSquaresFit& fit, const std::vector<Eigen::Index>& terms) {
  const auto q = static_cast<Eigen::Index>(terms.size());
  Eigen::VectorXd value(q);
  Eigen::MatrixXd covariance(q, q);
  double dof = std::numeric_limits<double>::infinity();
  for (Eigen::Index a = 0; a < q; ++a) {
    const Eigen::Index i = terms[static_cast<std::size_t>(a)];
    value(a) = fit.x(i);
    for (Eigen::Index b = 0; b < q; ++b)
      covariance(a, b) = fit.covariance(i, terms[static_cast<std::size_t>(b)]);
    dof = std::min(dof, fit.dof_of(Eigen::VectorXd::Unit(fit.x.size(), i)));
  }
  if (!covariance.allFinite()) return kNaN;
  const double f = value.dot(covariance.ldlt().solve(value)) / static_cast<double>(q);
  return 1.0 - f_cdf(f, static_cast<double>(q), dof);
}

}  // namespace

LawJudgement judge_law(const SweepChannel& channel, const ChannelResiduals& quadratic,
                       const ChannelResiduals& with_linear_term, const LeastSquaresFit& linear_fit) {
  LawJudgement law{.full_scale = channel.full_scale()};
  const double percent = 100.0 / law.full_scale;
  law.misfit_percent_fs = percent * quadratic.rms;
  law.with_linear_term_percent_fs = percent * with_linear_term.rms;
  law.noise_percent_fs = percent * quadratic.noise;
  std::vector<Eigen::Index> terms = {linear_fit.index(channel.name + "_slope")};
  if (!channel.rest.empty()) terms.push_back(linear_fit.index(channel.name + "_offset"));
  law.p_value = wald_p(linear_fit, terms);
  const double explained =
      std::sqrt(std::max(0.0, law.misfit_percent_fs * law.misfit_percent_fs -
                                  law.with_linear_term_percent_fs * law.with_linear_term_percent_fs));
  law.law_fails = law.p_value < kSignificant && explained > kMaterial;
  return law;
}

}  // namespace ident
