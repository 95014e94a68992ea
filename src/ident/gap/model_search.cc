// Forward search with refits, and the weights of alternative sets at the model found.
#include "ident/gap/model_search.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ident {
namespace {

// Log prior odds against each further cause, and the price of a direction (half the log of the effective
// sample).
constexpr double kOddsAgainst = 7.0;
constexpr double kPricePerDirection = 2.5;
// A cause has to explain this much, in units of the noise, to be adopted: 1 % family-wise over the catalogue.
constexpr double kLeastGain = 19.0;
constexpr double kPerDirection = 4.0;

FittedModel fitted(std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                   const FlightRecord& record, const std::vector<double>& p,
                   const FlightFitOptions& options) {
  FittedModel model;
  model.constants = std::move(constants);
  model.adopted = std::move(adopted);
  std::vector<FreeConstant> freed = model.constants;
  for (const Candidate& c : model.adopted)
    if (c.parameter >= 0) {
      FreeConstant& f = freed[static_cast<std::size_t>(c.parameter)];
      f.prior_std = 100 * f.prior_std.value_or(std::abs(f.start));
    }
  model.theta = std::make_shared<Theta>(p, freed, record.logs, record.signals.rates);
  model.fit = fit_flight(record, *model.theta, options);
  return model;
}

// `stretch` is common to all sets that are compared: a rival must not win because its own residual happens to
// be whiter.
double evidence(const SetGain& set, double stretch) {
  const double causes = static_cast<double>(set.members.size());
  return 0.5 * set.gain / stretch - kPricePerDirection * set.degrees - kOddsAgainst * causes;
}

double own_stretch(const QuadraticForm& form, const Candidate& c) {
  return stretch_of(form, c.parameter >= 0 ? std::vector<int>{c.parameter} : c.directions);
}

bool same(const Candidate& a, const Candidate& b) { return a.name == b.name && a.rotor == b.rotor; }

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
  tell(0.0, "the model as it is");
  std::vector<FreeConstant> base = free_constants(vehicle, p);
  if (!record.signals.commands)
    std::erase_if(base, [](const FreeConstant& c) {
      return c.index == param::km || c.index == param::omega_m || c.index == param::zeta_m ||
             c.index == param::dead_time || c.index == param::Omega_0;
    });
  out.base = fitted(base, {}, record, p, fit);
  out.best = out.base;
  for (int step = 0;; ++step) {
    tell(0.2 + 0.2 * step, "every cause");
    out.problem = extended_problem(vehicle, out.best.theta->p(out.best.fit.u), record.signals,
                                   out.best.constants, options.exclude);
    out.form = linearise_everything(record, out.best.fit, *out.best.theta, out.problem);
    if (step == 0) out.base_problem = out.problem, out.base_form = out.form;
    if (step >= options.most_causes) break;
    std::vector<int> have;
    for (std::size_t c = 0; c < out.problem.candidates.size(); ++c)
      if (std::ranges::any_of(out.best.adopted,
                              [&](const Candidate& a) { return same(a, out.problem.candidates[c]); }))
        have.push_back(static_cast<int>(c));
    const SetGain now = gain_of(out.form, out.problem, have);
    struct Passed {
      int candidate;
      double gain, own, stretch;
    };
    std::vector<Passed> passed;
    for (std::size_t c = 0; c < out.problem.candidates.size(); ++c) {
      if (std::ranges::find(have, static_cast<int>(c)) != have.end()) continue;
      std::vector<int> with = have;
      with.push_back(static_cast<int>(c));
      const SetGain set = gain_of(out.form, out.problem, with);
      const double own = set.degrees - now.degrees,
                   stretch = own_stretch(out.form, out.problem.candidates[c]);
      const double gain = set.gain - now.gain;
      if (set.physical && own >= 1 && gain / stretch > kLeastGain + kPerDirection * own)
        passed.push_back({static_cast<int>(c), gain, own, stretch});
    }
    int best = -1;
    double best_gain = 0;
    if (!passed.empty()) {
      const double common = std::ranges::max_element(passed, {}, &Passed::gain)->stretch;
      const auto score = [&](const Passed& c) { return 0.5 * c.gain / common - kPricePerDirection * c.own; };
      const Passed& top = *std::ranges::max_element(passed, {}, score);
      best = top.candidate, best_gain = top.gain / top.stretch;
    }
    if (best < 0) break;
    const Candidate chosen = out.problem.candidates[static_cast<std::size_t>(best)];
    tell(0.3 + 0.2 * step, described(chosen));
    std::vector<int> with = have;
    with.push_back(best);
    const SetGain set = gain_of(out.form, out.problem, with);
    // Constants of the model so far at their fitted values, the new ones at the step of the quadratic form.
    const std::vector<double> at = out.best.theta->p(out.best.fit.u);
    std::vector<FreeConstant> constants = out.best.constants;
    for (FreeConstant& c : constants) c.start = at[static_cast<std::size_t>(c.index)];
    for (FreeConstant c : constants_of(chosen, vehicle, at, record.signals.voltage)) {
      if (std::ranges::find(constants, c.name, &FreeConstant::name) != constants.end()) continue;
      for (const int i : chosen.directions) {
        const FreeConstant& d = out.problem.constants[static_cast<std::size_t>(i)];
        const double moved = d.start + d.scale * set.step[i];
        if (d.name == c.name) c.start = moved;
        if (chosen.name == "payload" && d.name.substr(0, 9) == "cg_offset" &&
            d.name.substr(9) == c.name.substr(7)) {
          const double mass =
              std::max(out.problem.constants[static_cast<std::size_t>(chosen.directions[0])].scale *
                           std::abs(set.step[chosen.directions[0]]),
                       1e-3 * at[param::m]);
          c.start = std::clamp(moved * at[param::m] / mass, -0.3, 0.3);
        }
      }
      c.adopted = true;
      constants.push_back(c);
    }
    std::vector<Candidate> adopted = out.best.adopted;
    adopted.push_back(chosen);
    FlightFitOptions again = fit;
    again.noise = out.form.noise;
    again.chunk_seconds = std::min(out.best.fit.chunk_seconds, chunk_for(record, out.form.noise));
    again.estimate_noise = false;
    FittedModel next = fitted(constants, adopted, record, at, again);
    out.steps.push_back({described(chosen), best_gain});
    out.best = std::move(next);
  }
  // Weigh sets of at most two causes (and the one found) at the model and noise found.
  const int n = static_cast<int>(out.problem.candidates.size());
  std::vector<std::vector<int>> sets{{}};
  std::vector<int> found;
  std::vector<std::pair<double, int>> singles;
  double common = 1;
  for (const Candidate& c : out.problem.candidates)
    if (std::ranges::any_of(out.best.adopted, [&](const Candidate& a) { return same(a, c); }))
      common = std::max(common, own_stretch(out.form, c));
  for (int c = 0; c < n; ++c) {
    if (std::ranges::any_of(out.best.adopted, [&](const Candidate& a) {
          return same(a, out.problem.candidates[static_cast<std::size_t>(c)]);
        }))
      found.push_back(c);
    sets.push_back({c});
    singles.emplace_back(-evidence(gain_of(out.form, out.problem, {c}), common), c);
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
  double top = -1e300;
  for (const std::vector<int>& members : sets) {
    const SetGain set = gain_of(out.form, out.problem, members);
    if (!set.physical) continue;
    double stretch = common;
    for (const int c : members)
      if (out.best.adopted.empty())
        stretch =
            std::max(stretch, own_stretch(out.form, out.problem.candidates[static_cast<std::size_t>(c)]));
    out.sets.push_back({members, evidence(set, stretch), 0.0});
    top = std::max(top, out.sets.back().log_evidence);
  }
  double sum = 0;
  for (WeighedSet& set : out.sets) sum += set.probability = std::exp(set.log_evidence - top);
  for (WeighedSet& set : out.sets) set.probability /= sum;
  std::ranges::sort(out.sets, std::greater<>(), &WeighedSet::probability);
  return out;
}

}  // namespace ident
