// What a search tells, and its counts.
#include "ident/gap/search/search_state.h"

#include <algorithm>
#include <utility>

#include "ident/gap/search/further.h"

namespace ident {
namespace {

// A model that misses much is good enough where so little of that is still to be had.
constexpr double kOfMisfit = 1e-4;
// Steps that a fit may take: what needs more has no minimum to speak of.
constexpr int kMostSteps = 40;

}  // namespace

SearchState::SearchState(const FlightRecord& of_record, const Vehicle& of_vehicle,
                         const std::vector<double>& stated, const SearchOptions& asked)
    : record(of_record), vehicle(of_vehicle), p(stated), options(asked) {
  fit.tolerance = 0.02;
  fit.noise_rounds = 4;
  fit.fine_gusts = options.fine_gusts;  // without, sets are compared under a dispersion common to them
  fit.choose_axes = false;              // a force that the model lacks would choose them
  fit.exact = false;                    // to a small share of a standard deviation is enough
  fit.rough_noise = true;
  fit.steps = Steps::longest;
  fit.most_steps = kMostSteps;
  fit.tolerance_of_misfit = kOfMisfit;
}

void SearchState::tell(double further, const std::string& what) const {
  const double share = 0.15 * static_cast<double>(out.steps.size()) + further;
  if (options.progress) options.progress(std::min(share, 0.85), what);
}

Standing SearchState::at(FittedModel model) const {
  return standing_at(record, vehicle, options.exclude, std::move(model));
}

void SearchState::move_to(Standing there) {
  now = std::move(there);
  before_mass.reset();
  tried.clear();
  out.steps = steps_here();
}

std::vector<SearchStep> SearchState::steps_here() const {
  std::vector<SearchStep> steps;
  for (const int c : now.have) {
    std::vector<int> others = now.have;
    std::erase(others, c);
    steps.push_back({described(candidate(c)), further(now, others, c).honest()});
  }
  return steps;
}

int SearchState::of_vehicle(const std::vector<int>& set) const {
  return static_cast<int>(
      std::ranges::count_if(set, [&](int c) { return !is_of_mounting(candidate(c).name); }));
}

bool SearchState::may_be_tried(const std::vector<int>& set) const {
  const auto ran_away = [&](int c) {
    return std::ranges::any_of(fell, [&](const Candidate& f) { return same(f, candidate(c)); });
  };
  return of_vehicle(set) <= options.most_causes && std::ranges::none_of(set, ran_away);
}

}  // namespace ident
