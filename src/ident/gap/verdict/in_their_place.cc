// Probabilities of sets, set against those of the names given.
#include "ident/gap/verdict/in_their_place.h"

#include <algorithm>
#include <functional>
#include <set>

#include "ident/effects/cause_traits.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

void add(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::vector<std::string> names_of_set(const WeighedSet& set, const SearchResult& search) {
  std::vector<Candidate> members;
  for (const int m : set.members) members.push_back(search.problem.candidates[static_cast<std::size_t>(m)]);
  return names_of(members);
}

// A mass that the flight hardly shows: only its moment was seen.
bool is_weightless(const std::string& name, const std::vector<Parameter>& fitted) {
  constexpr double kSeen = 5.0;  // standard deviations from none
  const auto mass = std::ranges::find(fitted, name + ".m", &Parameter::name);
  return traits_of(name).bolted_on && mass != fitted.end() && mass->value < kSeen * mass->std;
}

double probability_of_sets(const SearchResult& search, std::string_view with, std::string_view without) {
  double sum = 0;
  for (const WeighedSet& set : search.sets) {
    const std::vector<std::string> names = names_of_set(set, search);
    const auto has = [&](std::string_view n) { return std::ranges::find(names, n) != names.end(); };
    if (has(with) && !has(without)) sum += set.probability;
  }
  return sum;
}

}  // namespace

std::vector<std::string> in_their_place(const std::vector<std::string>& named, const SearchResult& search,
                                        const std::vector<Parameter>& fitted) {
  constexpr double kPart = 0.01;  // what a small cause may be as well is told of from here
  std::vector<std::string> out;
  const std::set<std::string> effects(named.begin(), named.end());
  const auto held = [&](const std::string& n) {
    return std::ranges::find(search.best.adopted, n, &Candidate::name) != search.best.adopted.end();
  };
  double own = 0;
  for (const WeighedSet& set : search.sets) {
    const std::vector<std::string> listed = names_of_set(set, search);
    const std::set<std::string> names(listed.begin(), listed.end());
    if (std::ranges::includes(names, effects)) {
      own += set.probability;
    } else if (set.probability > kTold) {
      const bool parts = std::ranges::all_of(names, held);  // drag alone, where it was wind with drag
      for (const std::string& n : names)
        if (parts ? !effects.contains(n) : !held(n)) add(out, n);
    }
  }
  if (own >= 1 - 2 * kTold) out.clear();  // what a sure set leaves to others is chance
  for (const std::string& name : named) {
    const std::string alias(traits_of(name).alias_of);
    if (is_weightless(name, fitted) && probability_of_sets(search, alias, name) > kPart) add(out, alias);
  }
  return out;
}

std::vector<std::string> nearest_names(const SearchResult& search) {
  std::vector<std::string> out = names_of(search.best.adopted), likely;
  for (const std::string& name : search.ran_away) add(out, name);
  for (const Candidate& c : search.problem.candidates)
    if (search.probability_of(c.name) > kTold) add(likely, c.name);
  std::ranges::stable_sort(likely, std::greater<>(), [&](const auto& n) { return search.probability_of(n); });
  for (const std::string& name : likely) add(out, name);
  return out;
}

}  // namespace ident
