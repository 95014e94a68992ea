// The constants of all other causes at the values at which they do nothing.
#include "ident/gap/hypotheses/cause_alone.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/cause_traits.h"
#include "ident/gap/hypotheses/candidates.h"
#include "ident/gap/hypotheses/next_model.h"

namespace ident {

Eigen::VectorXd with_only(const FittedModel& model, const Eigen::VectorXd& u,
                          const std::vector<Candidate>& causes) {
  constexpr double kNothing = -30.0;  // of the logarithm of what is positive
  Eigen::VectorXd out = u;
  const std::vector<FreeConstant>& constants = model.theta->constants();
  const bool moves_air =
      std::ranges::any_of(causes, [](const Candidate& c) { return traits_of(c.name).by_the_air; });
  for (const Candidate& other : model.adopted) {
    const bool kept = std::ranges::any_of(causes, [&](const Candidate& c) { return same(other, c); });
    if (kept || (moves_air && traits_of(other.name).carries_air)) continue;
    for (std::size_t i = 0; i < constants.size(); ++i) {
      const FreeConstant& c = constants[i];
      if (!is_constant_of(other, c, static_cast<int>(i))) continue;
      const double null = value_without(other, c);
      const auto k = static_cast<Eigen::Index>(i);
      if (c.positive)
        out[k] = null > 0 ? std::log(null / c.start) : kNothing;
      else
        out[k] = (null - c.start) / c.scale;
    }
  }
  return out;
}

std::vector<PredictionWindow> same_windows(const std::vector<PredictionWindow>& all,
                                           const std::vector<PredictionWindow>& some) {
  std::vector<PredictionWindow> out;
  auto next = all.begin();
  for (const PredictionWindow& one : some) {
    next = std::find_if(next, all.end(),
                        [&](const PredictionWindow& w) { return w.log == one.log && w.t == one.t; });
    if (next == all.end()) break;
    out.push_back(*next);
  }
  return out;
}

}  // namespace ident
