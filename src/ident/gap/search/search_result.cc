// Probabilities, gains and scatter of what was found.
#include "ident/gap/search/search_result.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"
#include "ident/effects/cause_traits.h"
#include "ident/gap/search/further.h"

namespace ident {

std::string described(const Candidate& c) {
  return c.rotor < 0 ? c.name : c.name + " (rotor " + std::to_string(c.rotor + 1) + ")";
}

std::vector<std::string> names_of(const std::vector<Candidate>& causes) {
  const auto brought_along = [&](const Candidate& c) {
    return std::ranges::any_of(causes, [&](const Candidate& other) {
      const CauseTraits& traits = traits_of(other.name);
      return (traits.by_the_air || traits.bolted_on) && implies(other.name, c.name);
    });
  };
  std::vector<std::string> names;
  for (const Candidate& c : causes)
    if (!brought_along(c) && std::ranges::find(names, c.name) == names.end()) names.push_back(c.name);
  return names;
}

double SearchResult::probability_of(const std::string& name) const {
  double sum = 0;
  for (const WeighedSet& set : sets)
    if (std::ranges::any_of(
            set.members, [&](int m) { return problem.candidates[static_cast<std::size_t>(m)].name == name; }))
      sum += set.probability;
  return std::min(sum, 1.0);
}

double SearchResult::explained() const {
  double sum = 0;
  for (const SearchStep& cause : alone) sum += cause.gain;
  return sum;
}

double SearchResult::scatter_of(const Candidate& adopted) const {
  for (const Candidate& c : problem.candidates)
    if (same(c, adopted)) return own_stretch(form, c);
  return 1.0;
}

double SearchResult::gain_before_scatter(const Candidate& adopted) const {
  const auto step = std::ranges::find(alone, described(adopted), &SearchStep::name);
  return step == alone.end() ? 0.0 : std::max(step->gain, 0.0) * scatter_of(adopted);
}

// A block of B tells the value with a variance of B / (information of all), and the gain is value^2 times
// that information.
double SearchResult::change_of(const Candidate& adopted) const {
  const double gain = gain_before_scatter(adopted);
  if (!(gain > 0)) return 0.0;
  return std::sqrt((scatter_of(adopted) - 1) * static_cast<double>(form.scores.cols()) / gain);
}

double SearchResult::usual_scatter() const {
  std::vector<double> all;
  for (const Candidate& c : problem.candidates) all.push_back(own_stretch(form, c));
  return all.empty() ? 1.0 : median(all);
}

}  // namespace ident
