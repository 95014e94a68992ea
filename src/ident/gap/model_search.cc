// Forward search with refits.
#include "ident/gap/model_search.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "ident/core/error.h"
#include "ident/gap/further.h"
#include "ident/gap/wrong_lag.h"

namespace ident {
namespace {

// The third and further causes have to explain this share of what was found: what is left of causes of nearly
// the right form gets names otherwise.
constexpr int kOften = 2;
constexpr double kMaterial = 0.04;
// A cause gains this much, whatever its scatter, to be tried in full.
constexpr double kWorthATrial = 100.0;

}  // namespace

std::string described(const Candidate& c) {
  return c.rotor < 0 ? c.name : c.name + " (rotor " + std::to_string(c.rotor + 1) + ")";
}

double SearchResult::probability_of(const std::string& name) const {
  double sum = 0;
  for (const WeighedSet& set : sets)
    if (std::ranges::any_of(
            set.members, [&](int m) { return problem.candidates[static_cast<std::size_t>(m)].name == name; }))
      sum += set.probability;
  return std::min(sum, 1.0);
}

double SearchResult::scatter_of(const Candidate& adopted) const {
  for (const Candidate& c : problem.candidates)
    if (same(c, adopted)) return own_stretch(form, c);
  return 1.0;
}

SearchResult search_causes(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
                           const SearchOptions& options) {
  SearchResult out;
  const auto tell = [&](double share, const std::string& what) {
    if (options.progress) options.progress(share, what);
  };
  FlightFitOptions fit;
  fit.tolerance = 0.02;
  fit.noise_rounds = 4;
  fit.fine_gusts = false;  // sets are compared under a dispersion that is common to them
  tell(0.0, "the model as it is");
  std::vector<FreeConstant> base = free_constants(vehicle, p);
  if (!record.signals.commands) leave_out_motors(base);
  out.base = fitted(base, {}, record, p, fit);
  if (!stands(out.base))
    throw DataError("the model as it is cannot be fitted to these logs: simulations with it run away");
  tell(0.15, "every cause");
  Standing now = standing_at(record, vehicle, options.exclude, out.base);
  if (lag_pulled_far(out.base)) {
    tell(0.2, "the motors' lag");
    if (auto lag = wrong_lag(record, p, out.base, now.problem, now.form, fit)) {
      out.steps.push_back({described(lag->cause), lag->gain / own_stretch(now.form, lag->cause)});
      out.base_problem = now.problem, out.base_form = now.form;
      now = standing_at(record, vehicle, options.exclude, std::move(lag->model));
    } else {
      // Speeds that a missing cause puts off their commands make the motors seem slow, and then no cause that
      // acts through the commands is seen: it is looked for at the lag stated.
      FittedModel held = with_lag_held(base, record, p, fit);
      if (stands(held)) {
        out.base = held;
        now = standing_at(record, vehicle, options.exclude, std::move(held));
      }
    }
  }
  if (out.steps.empty()) out.base_problem = now.problem, out.base_form = now.form;
  std::vector<Candidate> tried;         // and found no better where they act
  std::vector<Candidate> fell;          // whose fit ran away
  std::optional<Standing> before_mass;  // where no cause that moves masses was in the model
  std::size_t steps_before_mass = 0;
  const auto adopt = [&](std::string name, InFull next, double gain) {
    out.steps.push_back({std::move(name), gain});
    now = std::move(next.at);
  };
  while (static_cast<int>(out.steps.size()) < options.most_causes) {
    const double done = 0.2 + 0.2 * static_cast<double>(out.steps.size());
    std::vector<Further> passed;
    Further uneven;  // gains most, but a size that seems to change from block to block
    for (int c = 0; c < static_cast<int>(now.problem.candidates.size()); ++c) {
      if (std::ranges::find(now.have, c) != now.have.end()) continue;
      const Candidate& cause = now.problem.candidates[static_cast<std::size_t>(c)];
      const auto is_it = [&](const Candidate& t) { return same(t, cause); };
      if (std::ranges::any_of(fell, is_it)) continue;
      const Further f = further(now, now.have, c);
      if (f.passes()) passed.push_back(f);
      if (f.possible && f.gain > uneven.gain && std::ranges::none_of(tried, is_it)) uneven = f;
    }
    Further best;
    if (!passed.empty()) {
      const double common = std::ranges::max_element(passed, {}, &Further::gain)->stretch;
      best = *std::ranges::max_element(passed, {},
                                       [&](const Further& f) { return 0.5 * f.gain / common - f.price; });
    }
    // A delay or a lever arm, linearised where it is zero, gains most and yet looks uneven: it is judged
    // where it acts.
    if (uneven.gain > kWorthATrial && uneven.gain > 3 * best.gain && tried.size() < 2) {
      const Candidate cause = now.problem.candidates[static_cast<std::size_t>(uneven.candidate)];
      tell(done + 0.05, described(cause));
      auto trial = tried_in_full(record, vehicle, options.exclude, now, uneven.candidate, fit);
      if (!trial) {
        fell.push_back(cause);
        continue;
      }
      const double gain = trial->own.honest();
      if (trial->own.passes() && gain > best.honest()) {
        adopt(described(cause), std::move(*trial), gain);
        continue;
      }
      tried.push_back(cause);
    }
    double found = 0;
    for (const SearchStep& s : out.steps) found += s.gain;
    const bool often = static_cast<int>(out.steps.size()) >= kOften;
    if (best.candidate < 0 || (often && best.honest() < kMaterial * found)) break;
    const Candidate chosen = now.problem.candidates[static_cast<std::size_t>(best.candidate)];
    if (moves_mass(chosen) && before_mass) {
      tell(done + 0.1, "payload");
      std::vector<Candidate> moving{chosen};
      std::ranges::copy_if(now.model.adopted, std::back_inserter(moving), moves_mass);
      auto payload = payload_instead(record, vehicle, options.exclude, *before_mass, moving, fit);
      before_mass.reset();
      if (payload) {
        out.steps.resize(steps_before_mass);
        const double gain = payload->own.honest();
        adopt("payload", std::move(*payload), gain);
        continue;
      }
    }
    tell(done + 0.1, described(chosen));
    auto next = tried_in_full(record, vehicle, options.exclude, now, best.candidate, fit);
    if (!next) {
      fell.push_back(chosen);
      continue;
    }
    if (moves_mass(chosen) && std::ranges::none_of(now.model.adopted, moves_mass))
      before_mass = now, steps_before_mass = out.steps.size();
    adopt(described(chosen), std::move(*next), best.honest());
  }
  // Those that still gain beside what was found.
  for (const int c : places_of(fell, now.problem))
    if (further(now, now.have, c).passes())
      out.ran_away.push_back(described(now.problem.candidates[static_cast<std::size_t>(c)]));
  out.sets = weighed_sets(now);
  out.best = std::move(now.model), out.problem = std::move(now.problem), out.form = std::move(now.form);
  return out;
}

}  // namespace ident
