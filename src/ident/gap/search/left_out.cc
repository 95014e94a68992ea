// Weights of sets in which a cause that was left out takes the place of one that was found.
#include "ident/gap/search/left_out.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/cause_traits.h"
#include "ident/gap/search/weigh_sets.h"

namespace ident {
namespace {

using Set = std::vector<int>;

constexpr double kMost = 300.0;         // of a logarithm
constexpr std::size_t kMostCauses = 6;  // whose subsets are weighed

const std::string& name_of(const Standing& at, int c) {
  return at.problem.candidates[static_cast<std::size_t>(c)].name;
}

// None, one, or two of different names.
std::vector<Set> some_of(const Standing& at, const Set& left_out) {
  std::vector<Set> out{{}};
  for (const int x : left_out) out.push_back({x});
  for (const int x : left_out)
    for (const int y : left_out)
      if (x < y && name_of(at, x) != name_of(at, y)) out.push_back({x, y});
  return out;
}

// A set with what one of those left out brings along as part of that: the causes found that `more` implies.
double log_weight(const Standing& all, const Set& found, const Set& more) {
  Set set = found;
  set.insert(set.end(), more.begin(), more.end());
  if (!gain_of(all.form, all.problem, set).physical()) return -kMost;
  const auto brought = std::ranges::count_if(found, [&](int c) {
    return std::ranges::any_of(more, [&](int x) { return implies(name_of(all, x), name_of(all, c)); });
  });
  return std::clamp(log_odds(all, set, all.have) + kOddsAgainst * static_cast<double>(brought), -kMost,
                    kMost);
}

}  // namespace

std::vector<BesideLeftOut> beside_left_out(const Standing& all, const std::vector<std::string>& left_out) {
  Set others;
  for (int c = 0; c < static_cast<int>(all.problem.candidates.size()); ++c)
    if (std::ranges::find(left_out, name_of(all, c)) != left_out.end()) others.push_back(c);
  const std::vector<Set> more = some_of(all, others);
  const std::size_t causes = std::min(all.have.size(), kMostCauses);
  std::vector<double> with(causes, 0.0);
  double sum = 0;
  for (unsigned part = 0; part < 1U << causes; ++part) {
    Set found(all.have.begin() + static_cast<std::ptrdiff_t>(causes), all.have.end());
    for (std::size_t k = 0; k < causes; ++k)
      if (part >> k & 1U) found.push_back(all.have[k]);
    for (const Set& x : more) {
      // Without any of those left out the search has chosen already.
      if (x.empty() && found.size() < all.have.size()) continue;
      const double weight = x.empty() ? 1.0 : std::exp(log_weight(all, found, x));
      sum += weight;
      for (std::size_t k = 0; k < causes; ++k) {
        const std::string& name = name_of(all, all.have[k]);
        const bool brought =
            std::ranges::any_of(x, [&](int other) { return implies(name_of(all, other), name); });
        if ((part >> k & 1U) != 0 && !brought) with[k] += weight;
      }
    }
  }
  std::vector<BesideLeftOut> out;
  for (std::size_t k = 0; k < causes; ++k) {
    const std::string& name = name_of(all, all.have[k]);
    const auto known = std::ranges::find(out, name, &BesideLeftOut::name);
    if (known == out.end())
      out.push_back({name, with[k] / sum});
    else  // of another rotor
      known->probability = std::max(known->probability, with[k] / sum);
  }
  // What looks the same where it is small, and was fitted at its best, is not weighed by a form at that.
  for (BesideLeftOut& cause : out)
    if (std::ranges::find(left_out, traits_of(cause.name).alias_of) != left_out.end())
      cause.probability = std::min(cause.probability, 0.5);
  return out;
}

}  // namespace ident
