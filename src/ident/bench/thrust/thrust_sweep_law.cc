// Wald's test of the linear term, and how much of full scale the law misses.
#include "ident/bench/thrust/thrust_sweep_law.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kSignificant = 0.01;
constexpr double kMaterial = 0.5;  // % of full scale that the linear term takes away from the misfit

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
  law.p_value = linear_fit.p_of_zero(terms);
  const double explained =
      std::sqrt(std::max(0.0, law.misfit_percent_fs * law.misfit_percent_fs -
                                  law.with_linear_term_percent_fs * law.with_linear_term_percent_fs));
  law.law_fails = law.p_value < kSignificant && explained > kMaterial;
  return law;
}

}  // namespace ident
