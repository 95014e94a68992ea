// Evidence of sets of causes by the quadratic form.
#include "ident/gap/search/weigh_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "ident/core/stage_times.h"
#include "ident/gap/search/further.h"

namespace ident {
namespace {

constexpr double kNone = -1e300;

// `stretch` is common to all sets that are compared: a rival must not win because its own residual happens to
// be whiter.
double evidence(const SetGain& set, double stretch) {
  const double causes = static_cast<double>(set.members.size());
  const double log = 0.5 * set.gain / stretch - set.price - kOddsAgainst * causes;
  return std::isfinite(log) ? log : kNone;  // of a form that rounding left without a minimum
}

// By how much colour inflates what the causes found gain: the most of them.
double found_stretch(const Standing& at) {
  double common = 1;
  for (const int c : at.have)
    common = std::max(common, own_stretch(at.form, at.problem.candidates[static_cast<std::size_t>(c)]));
  return common;
}

}  // namespace

double log_odds(const Standing& at, const std::vector<int>& one, const std::vector<int>& other) {
  const double common = found_stretch(at);
  return evidence(gain_of(at.form, at.problem, one), common) -
         evidence(gain_of(at.form, at.problem, other), common);
}

std::vector<WeighedSet> weighed_sets(const Standing& at) {
  const Stage stage("sets weighed");
  std::vector<WeighedSet> out;
  const int n = static_cast<int>(at.problem.candidates.size());
  std::vector<std::vector<int>> sets{{}};
  const std::vector<int>& found = at.have;
  std::vector<std::pair<double, int>> singles;
  const double common = found_stretch(at);
  for (int c = 0; c < n; ++c) {
    sets.push_back({c});
    singles.emplace_back(-evidence(gain_of(at.form, at.problem, {c}), common), c);
  }
  std::ranges::sort(singles);
  // Pairs of each found cause with every other, and of the best singles with each other.
  const auto add = [&](std::vector<int> set) {
    std::ranges::sort(set);
    set.erase(std::unique(set.begin(), set.end()), set.end());
    if (std::ranges::find(sets, set) == sets.end()) sets.push_back(set);
  };
  for (const int f : found)
    for (int c = 0; c < n; ++c) add({f, c});
  for (std::size_t a = 0; a < std::min<std::size_t>(singles.size(), 10); ++a)
    for (std::size_t b = 0; b < a; ++b) add({singles[a].second, singles[b].second});
  add(found);
  if (found.size() >= 2)
    for (std::size_t drop = 0; drop < found.size(); ++drop)
      for (int c = 0; c < n; ++c) {
        std::vector<int> set = found;
        set[drop] = c;
        add(set);
      }
  double top = kNone;
  for (const std::vector<int>& members : sets) {
    const SetGain set = gain_of(at.form, at.problem, members);
    if (!set.physical()) continue;
    double stretch = common;
    for (const int c : members)
      if (at.model.adopted.empty())
        stretch = std::max(stretch, own_stretch(at.form, at.problem.candidates[static_cast<std::size_t>(c)]));
    out.push_back({members, evidence(set, stretch), 0.0});
    top = std::max(top, out.back().log_evidence);
  }
  double sum = 0;
  for (WeighedSet& set : out) sum += set.probability = std::exp(set.log_evidence - top);
  for (WeighedSet& set : out) set.probability /= sum;
  std::ranges::sort(out, std::greater<>(), &WeighedSet::probability);
  return out;
}

}  // namespace ident
