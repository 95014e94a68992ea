// Gains of a further cause, by the quadratic form and by a fit.
#include "ident/gap/search/further.h"

#include <algorithm>
#include <utility>

#include "ident/effects/cause_traits.h"

namespace ident {
namespace {

// A cause has to explain this much, in units of the noise, to be adopted: 1 % family-wise over the catalogue.
constexpr double kLeastGain = 19.0;
constexpr double kPerDirection = 4.0;

}  // namespace

double own_stretch(const QuadraticForm& form, const Candidate& cause) {
  return stretch_of(form, cause.parameter >= 0 ? std::vector<int>{cause.parameter} : cause.directions);
}

bool Further::passes() const { return possible && honest() > kLeastGain + kPerDirection * degrees; }

Further further(const Standing& at, const std::vector<int>& have, int candidate) {
  std::vector<int> with = have;
  with.push_back(candidate);
  const SetGain set = gain_of(at.form, at.problem, with), now = gain_of(at.form, at.problem, have);
  const double degrees = set.degrees - now.degrees;
  return {candidate,
          set.gain - now.gain,
          set.price - now.price,
          own_stretch(at.form, at.problem.candidates[static_cast<std::size_t>(candidate)]),
          degrees,
          set.physical() && degrees >= 1,
          set.signs && !set.sizes && degrees >= 1};
}

namespace {

// A cause in full beside some of those that the model has; the others go.
std::optional<InFull> tried_beside(const FlightRecord& record, const Vehicle& vehicle,
                                   const std::vector<std::string>& exclude, const Standing& at_now,
                                   std::vector<int> with, int chosen, const FlightFitOptions& options) {
  with.push_back(chosen);
  FittedModel model = with_causes(record, vehicle, at_now, with, options);
  if (!stands(model)) return {};
  InFull out{standing_at(record, vehicle, exclude, std::move(model)), {}};
  const Candidate& cause = at_now.problem.candidates[static_cast<std::size_t>(chosen)];
  const std::vector<int> own = places_of({cause}, out.at.problem);
  if (own.empty()) return out;
  std::vector<int> others = out.at.have;
  std::erase(others, own[0]);
  out.own = further(out.at, others, own[0]);
  return out;
}

}  // namespace

std::optional<InFull> tried_in_full(const FlightRecord& record, const Vehicle& vehicle,
                                    const std::vector<std::string>& exclude, const Standing& at_now,
                                    int chosen, const FlightFitOptions& options) {
  return tried_beside(record, vehicle, exclude, at_now, at_now.have, chosen, options);
}

bool moves_mass(const Candidate& cause) {
  const CauseTraits& traits = traits_of(cause.name);
  return traits.moves_mass && !traits.bolted_on;
}

bool is_of_mounting(const std::string& cause) { return traits_of(cause).of_mounting; }

bool is_lag(const std::string& cause) { return traits_of(cause).of_lag; }

std::optional<InFull> payload_instead(const FlightRecord& record, const Vehicle& vehicle,
                                      const std::vector<std::string>& exclude, const Standing& from,
                                      const std::vector<Candidate>& instead_of,
                                      const FlightFitOptions& options) {
  const auto payload = std::ranges::find_if(from.problem.candidates,
                                            [](const Candidate& c) { return traits_of(c.name).bolted_on; });
  if (payload == from.problem.candidates.end()) return {};
  const int place = static_cast<int>(payload - from.problem.candidates.begin());
  if (std::ranges::find(from.have, place) != from.have.end()) return {};
  std::vector<int> others = from.have;
  std::erase_if(others,
                [&](int c) { return moves_mass(from.problem.candidates[static_cast<std::size_t>(c)]); });
  std::optional<InFull> trial =
      tried_beside(record, vehicle, exclude, from, std::move(others), place, options);
  if (!trial) return {};
  for (const int c : places_of(instead_of, trial->at.problem))
    if (further(trial->at, trial->at.have, c).passes()) return {};
  return trial;
}

}  // namespace ident
