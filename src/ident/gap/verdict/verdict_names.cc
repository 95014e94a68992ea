// Names by the probabilities of sets.
#include "ident/gap/verdict/verdict_names.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "ident/gap/verdict/against_naming.h"

namespace ident {
namespace {

// A cause is identified with this probability, and one that stands in its place is told of from that on.
constexpr double kSure = 0.9;
constexpr double kTold = 0.05;

// A thrust curve that bends by less than thrust stands scatter, and that the flight hardly shows.
bool bends_next_to_nothing(const SearchResult& search, const std::vector<Parameter>& fitted) {
  constexpr double kOfAStand = 1.0 / 60, kPlain = 200.0;
  const auto of_curve = std::ranges::find(search.alone, "thrust_curve", &SearchStep::name);
  if (of_curve == search.alone.end() || of_curve->gain > kPlain) return false;
  return std::ranges::all_of(fitted, [&](const Parameter& p) {
    return !p.name.starts_with("thrust_curve.") || std::abs(p.value) < kOfAStand;
  });
}

// Names of sets that explain the gap about as well and hold another cause than those found; `own` becomes the
// probability of the sets that hold these. One with a further cause beside them is no rival, and what the
// model holds in any case, as the drag by which wind acts, is none.
std::vector<std::string> in_their_place(const SearchResult& search, const std::vector<std::string>& effects,
                                        double& own) {
  std::vector<std::string> others;
  const std::set<std::string> named(effects.begin(), effects.end());
  const auto held = [&](const std::string& n) {
    return std::ranges::find(search.best.adopted, n, &Candidate::name) != search.best.adopted.end();
  };
  for (const WeighedSet& set : search.sets) {
    std::vector<Candidate> members;
    for (const int m : set.members) members.push_back(search.problem.candidates[static_cast<std::size_t>(m)]);
    const std::vector<std::string> listed = names_of(members);
    const std::set<std::string> names(listed.begin(), listed.end());
    if (std::ranges::includes(names, named)) {
      own += set.probability;
    } else if (set.probability > kTold) {
      const bool parts = std::ranges::all_of(names, held);  // drag alone, where it was wind with drag
      for (const std::string& n : names)
        if ((parts ? !named.contains(n) : !held(n)) && std::ranges::find(others, n) == others.end())
          others.push_back(n);
    }
  }
  return others;
}

}  // namespace

std::vector<std::string> probable_names(const SearchResult& search, const std::vector<Parameter>& fitted) {
  constexpr double kHardlyThere = 0.1, kThere = 0.5;
  std::vector<std::string> names = names_of(search.best.adopted);
  const auto there = [&](const std::string& n) { return search.probability_of(n) > kThere; };
  if (std::ranges::any_of(names, there))
    std::erase_if(names, [&](const std::string& n) {
      return search.probability_of(n) < kHardlyThere && !(n == "battery_sag" && search.thrust.plain());
    });
  if (names.size() > 1 && bends_next_to_nothing(search, fitted)) std::erase(names, "thrust_curve");
  return names;
}

std::vector<std::string> likely_names(const SearchResult& search) {
  std::vector<std::string> out;
  for (const Candidate& c : search.problem.candidates)
    if (search.probability_of(c.name) > kTold && std::ranges::find(out, c.name) == out.end())
      out.push_back(c.name);
  std::ranges::stable_sort(out, std::greater<>(), [&](const auto& n) { return search.probability_of(n); });
  return out;
}

std::vector<std::string> names_in_place_of(const std::vector<std::string>& names, const SearchResult& search,
                                           const std::vector<Parameter>& fitted) {
  double own = 0;
  std::vector<std::string> others = in_their_place(search, names, own);
  // What a cause that is sure leaves to others is not told, but for a payload: too light to be weighed it is
  // a shifted centre of gravity, and only its price tells it from one.
  const bool shifted = std::ranges::find(names, "cg_offset") != names.end();
  if (own >= kSure) std::erase_if(others, [&](const std::string& n) { return !shifted || n != "payload"; });
  if (weightless_payload(search, fitted) && std::ranges::find(others, "cg_offset") == others.end())
    others.emplace_back("cg_offset");
  return others;
}

}  // namespace ident
