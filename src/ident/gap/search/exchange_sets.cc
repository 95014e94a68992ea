// Exchange by the weights, each set judged where it acts.
#include "ident/gap/search/exchange_sets.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "ident/gap/search/further.h"

namespace ident {
namespace {

// Causes found that are no more probable than this among all sets are exchanged.
constexpr double kHardly = 0.3;
// And one of two goes if they are no more probable than this with it.
constexpr double kAlmostNever = 0.03;
constexpr int kOften = 2;
// Sets that are no less probable than this share of the one found are looked at in full, so many of them, and
// one is taken that leaves so little of what the one found leaves to others.
constexpr double kNotRuledOut = 1e-3;
constexpr std::size_t kAlternatives = 4;
constexpr double kLess = 0.9;
// Steps that the fit of another set may take; that of a right one takes three to seven.
constexpr int kAlternativeSteps = 20;

// The model with other causes, if all of them act there and the weights prefer them there, too.
std::optional<Standing> preferred_in_full(const SearchState& s, const std::vector<int>& causes) {
  std::string names;
  for (const int c : causes) names += (names.empty() ? "" : ", ") + described(s.candidate(c));
  s.tell(0.1, names);
  FlightFitOptions brief = s.fit;  // what flies as well as the set found is found as soon
  brief.most_steps = kAlternativeSteps;
  FittedModel model = with_causes(s.record, s.vehicle, s.now, causes, brief);
  if (!stands(model)) return {};
  Standing there = s.at(std::move(model));
  const std::vector<int> before = places_of(s.now.model.adopted, there.problem);
  if (there.have.size() != causes.size() || !(log_odds(there, there.have, before) > 0)) return {};
  return there;
}

// The most that any further cause would explain.
double left_to_others(const Standing& at) {
  double left = 0;
  for (int c = 0; c < static_cast<int>(at.problem.candidates.size()); ++c)
    if (std::ranges::find(at.have, c) == at.have.end())
      if (const Further f = further(at, at.have, c); f.passes()) left = std::max(left, f.honest());
  return left;
}

}  // namespace

bool exchange(SearchState& s) {
  if (s.now.have.empty()) return false;
  const std::vector<int> kept = places_of(s.kept, s.now.problem);
  double all = 0, own = 0;
  const WeighedSet* best = nullptr;
  const std::vector<WeighedSet> sets = weighed_sets(s.now);
  for (const WeighedSet& set : sets) {
    if (!std::ranges::includes(set.members, kept) || !s.may_be_tried(set.members)) continue;
    if (!best) best = &set;
    all += set.probability;
    if (std::ranges::includes(set.members, s.now.have)) own += set.probability;
  }
  if (!best || own > kHardly * all) return false;
  // One of two that gains enough to be found stays unless the other does its work; a third that weighs
  // nothing goes.
  const bool drops = std::ranges::includes(s.now.have, best->members);
  if (drops && static_cast<int>(s.now.have.size()) <= kOften && own > kAlmostNever * all) return false;
  const std::vector<Candidate> before = s.now.model.adopted;
  std::optional<Standing> preferred = preferred_in_full(s, best->members);
  if (!preferred) return false;
  Standing& there = *preferred;
  if (drops) {
    std::vector<int> gone = places_of(before, there.problem);
    std::erase_if(gone, [&](int c) { return std::ranges::find(there.have, c) != there.have.end(); });
    if (std::ranges::any_of(gone, [&](int c) { return further(there, there.have, c).passes(); }))
      return false;  // what it was adopted for is still there
    for (const int c : gone) s.dropped.push_back(there.problem.candidates[static_cast<std::size_t>(c)]);
  }
  s.move_to(std::move(there));
  return true;
}

bool take_alternative(SearchState& s, LookedAt& looked_at) {
  const double left = left_to_others(s.now);
  const std::vector<int> kept = places_of(s.kept, s.now.problem);
  const std::vector<WeighedSet> sets = weighed_sets(s.now);
  const auto own = std::ranges::find(sets, s.now.have, &WeighedSet::members);
  if (own == sets.end()) return false;
  for (const WeighedSet& set : sets) {
    if (looked_at.size() >= kAlternatives || set.probability < kNotRuledOut * own->probability) break;
    std::vector<Candidate> causes;
    for (const int c : set.members) causes.push_back(s.candidate(c));
    if (set.members.size() != s.now.have.size() || set.members == s.now.have ||
        !std::ranges::includes(set.members, kept) || !s.may_be_tried(set.members) ||
        std::ranges::any_of(looked_at, [&](const auto& l) { return std::ranges::equal(l, causes, same); }))
      continue;
    looked_at.push_back(std::move(causes));
    std::optional<Standing> there = preferred_in_full(s, set.members);
    if (!there || left_to_others(*there) > kLess * left) continue;
    s.move_to(std::move(*there));
    return true;
  }
  return false;
}

}  // namespace ident
