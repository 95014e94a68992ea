// A true cause keeps its size.
#include "ident/gap/input_smoothing.h"

#include <cmath>

#include "ident/effects/catalogue.h"

namespace ident {
namespace {

// Share of a cause's size that may move, both in standard deviations, and what counts as moved at all.
constexpr double kMovesBy = 0.25, kMoves = 1.0;

double null_of(const FreeConstant& constant, const Candidate& cause) {
  if (cause.parameter >= 0) return constant.prior_value;
  const EffectParameter* parameter = find_effect_parameter(constant.name);
  return parameter ? parameter->null_value : 0.0;
}

}  // namespace

std::string depends_on_smoothing(const FittedModel& model, const Eigen::VectorXd& moved) {
  const Theta& theta = *model.theta;
  for (const Candidate& cause : model.adopted) {
    double size = 0, moves = 0;
    for (int i = 0; i < theta.constants_count(); ++i) {
      const FreeConstant& constant = theta.constants()[static_cast<std::size_t>(i)];
      if (!is_constant_of(cause, constant, i)) continue;
      const double std = theta.deviation(model.fit.u, i, model.fit.covariance),
                   value = theta.physical(model.fit.u, i);
      if (!(std > 0)) continue;
      size += std::pow((value - null_of(constant, cause)) / std, 2);
      moves += std::pow(theta.slope(model.fit.u, i) * moved[i] / std, 2);
    }
    if (moves > kMoves * kMoves && moves > kMovesBy * kMovesBy * size) return cause.name;
  }
  return {};
}

}  // namespace ident
