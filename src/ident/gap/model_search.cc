// Forward search with refits, and the weights of alternative sets at the model found.
#include "ident/gap/model_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "ident/core/error.h"
#include "ident/gap/next_model.h"
#include "ident/gap/wrong_lag.h"

namespace ident {
namespace {

// Log prior odds against each further cause.
constexpr double kOddsAgainst = 7.0;
// A cause has to explain this much, in units of the noise, to be adopted: 1 % family-wise over the catalogue.
constexpr double kLeastGain = 19.0;
constexpr double kPerDirection = 4.0;
// The third and further ones this share of what was found: what is left of causes of nearly the right form
// gets names otherwise.
constexpr int kOften = 2;
constexpr double kMaterial = 0.04;
// And this much, whatever its scatter, to be tried in full.
constexpr double kWorthATrial = 100.0;

// `stretch` is common to all sets that are compared: a rival must not win because its own residual happens to
// be whiter.
double evidence(const SetGain& set, double stretch) {
  const double causes = static_cast<double>(set.members.size());
  return 0.5 * set.gain / stretch - set.price - kOddsAgainst * causes;
}

double own_stretch(const QuadraticForm& form, const Candidate& c) {
  return stretch_of(form, c.parameter >= 0 ? std::vector<int>{c.parameter} : c.directions);
}

bool same(const Candidate& a, const Candidate& b) { return a.name == b.name && a.rotor == b.rotor; }

std::vector<int> places_of(const std::vector<Candidate>& adopted, const ExtendedProblem& problem) {
  std::vector<int> places;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c)
    if (std::ranges::any_of(adopted, [&](const Candidate& a) { return same(a, problem.candidates[c]); }))
      places.push_back(static_cast<int>(c));
  return places;
}

// What a further cause gains where everything stands linearised.
struct Further {
  int candidate = -1;
  double gain = 0, price = 0, stretch = 1;
  bool possible = false;

  double honest() const { return gain / stretch; }
  bool passes(double degrees) const { return possible && honest() > kLeastGain + kPerDirection * degrees; }
};
Further further(const QuadraticForm& form, const ExtendedProblem& problem, const std::vector<int>& have,
                int candidate, double& degrees) {
  std::vector<int> with = have;
  with.push_back(candidate);
  const SetGain set = gain_of(form, problem, with), now = gain_of(form, problem, have);
  degrees = set.degrees - now.degrees;
  return {candidate, set.gain - now.gain, set.price - now.price,
          own_stretch(form, problem.candidates[static_cast<std::size_t>(candidate)]),
          set.physical && degrees >= 1};
}

// A cause that moves masses about, as something bolted on would.
bool moves_mass(const Candidate& c) {
  return c.name == "cg_offset" || c.name == "products_of_inertia" || c.name == "parameter:m" ||
         c.name == "parameter:Jxx" || c.name == "parameter:Jyy" || c.name == "parameter:Jzz";
}

// Where the search stood before it took up the first of those.
struct BeforeMass {
  FittedModel model;
  ExtendedProblem problem;
  QuadraticForm form;
  std::vector<int> have;
  std::size_t steps = 0;
};

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
  const auto everything_at = [&](const FittedModel& model, ExtendedProblem& problem) {
    problem = extended_problem(vehicle, model.theta->p(model.fit.u), record.signals, model.constants,
                               options.exclude);
    return linearise_everything(record, model.fit, *model.theta, problem);
  };
  if (!stands(out.base))
    throw DataError("the model as it is cannot be fitted to these logs: simulations with it run away");
  out.best = out.base;
  if (lag_pulled_far(out.base)) {
    tell(0.15, "the motors' lag");
    out.base_form = everything_at(out.base, out.base_problem);
    if (auto lag = wrong_lag(record, p, out.base, out.base_problem, out.base_form, fit)) {
      out.steps.push_back({described(lag->cause), lag->gain / own_stretch(out.base_form, lag->cause)});
      out.best = std::move(lag->model);
    } else {
      // Speeds that a missing cause puts off their commands make the motors seem slow, and then no cause that
      // acts through the commands is seen: it is looked for at the lag stated.
      FittedModel held = with_lag_held(base, record, p, fit);
      if (stands(held)) out.best = out.base = std::move(held);
    }
  }
  std::optional<BeforeMass> before_mass;
  // Two causes that move masses may be one payload, which shows its inertia only where it acts. It stands if
  // with it none of them gains any more.
  const auto payload_instead = [&](const Candidate& next) {
    if (!before_mass || !moves_mass(next)) return false;
    const BeforeMass at = *std::exchange(before_mass, std::nullopt);
    const auto payload = std::ranges::find(at.problem.candidates, "payload", &Candidate::name);
    if (payload == at.problem.candidates.end()) return false;
    tell(0.3 + 0.2 * static_cast<double>(at.steps), "payload");
    FittedModel trial = with_cause(record, vehicle, {at.model, at.problem, at.form}, at.have,
                                   static_cast<int>(payload - at.problem.candidates.begin()), fit);
    if (!stands(trial)) return false;
    ExtendedProblem problem;
    QuadraticForm form = everything_at(trial, problem);
    const std::vector<int> have = places_of(trial.adopted, problem);
    double degrees = 0;
    for (int c = 0; c < static_cast<int>(problem.candidates.size()); ++c) {
      const Candidate& other = problem.candidates[static_cast<std::size_t>(c)];
      const bool replaced =
          same(other, next) || std::ranges::any_of(out.best.adopted, [&](const Candidate& a) {
            return moves_mass(a) && same(a, other);
          });
      if (replaced && further(form, problem, have, c, degrees).passes(degrees)) return false;
    }
    std::vector<int> without = have;
    std::erase_if(without,
                  [&](int c) { return problem.candidates[static_cast<std::size_t>(c)].name == "payload"; });
    const int place = *std::ranges::find_if(
        have, [&](int c) { return problem.candidates[static_cast<std::size_t>(c)].name == "payload"; });
    out.steps.resize(at.steps);
    out.steps.push_back({"payload", further(form, problem, without, place, degrees).honest()});
    out.best = std::move(trial);
    return true;
  };
  std::vector<Candidate> tried;  // and found no better where they act
  std::vector<Candidate> fell;   // whose fit ran away
  const auto runs_away = [&](const FittedModel& model, const Candidate& cause) {
    if (stands(model)) return false;
    fell.push_back(cause);
    return true;
  };
  for (bool moved = true;;) {
    const auto step = static_cast<int>(out.steps.size());
    if (std::exchange(moved, false)) {
      tell(0.2 + 0.2 * step, "every cause");
      out.form = everything_at(out.best, out.problem);
      if (step == 0) out.base_problem = out.problem, out.base_form = out.form;
    }
    if (step >= options.most_causes) break;
    const std::vector<int> have = places_of(out.best.adopted, out.problem);
    std::vector<Further> passed;
    Further uneven;  // gains most, but a size that seems to change from block to block
    for (int c = 0; c < static_cast<int>(out.problem.candidates.size()); ++c) {
      if (std::ranges::find(have, c) != have.end()) continue;
      const Candidate& cause = out.problem.candidates[static_cast<std::size_t>(c)];
      const auto is_it = [&](const Candidate& t) { return same(t, cause); };
      if (std::ranges::any_of(fell, is_it)) continue;
      double degrees = 0;
      const Further f = further(out.form, out.problem, have, c, degrees);
      if (f.passes(degrees)) passed.push_back(f);
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
      const Candidate cause = out.problem.candidates[static_cast<std::size_t>(uneven.candidate)];
      tell(0.25 + 0.2 * step, described(cause));
      FittedModel trial =
          with_cause(record, vehicle, {out.best, out.problem, out.form}, have, uneven.candidate, fit);
      if (runs_away(trial, cause)) continue;
      ExtendedProblem problem;
      const QuadraticForm form = everything_at(trial, problem);
      std::vector<int> others = places_of(trial.adopted, problem);
      const auto own = std::ranges::find_if(
          others, [&](int c) { return same(problem.candidates[static_cast<std::size_t>(c)], cause); });
      if (own != others.end()) {
        const int place = *own;
        others.erase(own);
        double degrees = 0;
        const Further there = further(form, problem, others, place, degrees);
        if (there.passes(degrees) && there.honest() > best.honest()) {
          out.steps.push_back({described(cause), there.honest()});
          out.best = std::move(trial);
          moved = true;
          continue;
        }
      }
      tried.push_back(cause);
    }
    double found = 0;
    for (const SearchStep& s : out.steps) found += s.gain;
    if (best.candidate < 0 || (step >= kOften && best.honest() < kMaterial * found)) break;
    const Candidate chosen = out.problem.candidates[static_cast<std::size_t>(best.candidate)];
    if (payload_instead(chosen)) {
      moved = true;
      continue;
    }
    tell(0.3 + 0.2 * step, described(chosen));
    FittedModel next =
        with_cause(record, vehicle, {out.best, out.problem, out.form}, have, best.candidate, fit);
    if (runs_away(next, chosen)) continue;
    if (moves_mass(chosen)) before_mass = {out.best, out.problem, out.form, have, out.steps.size()};
    out.steps.push_back({described(chosen), best.honest()});
    out.best = std::move(next);
    moved = true;
  }
  // Those that still gain beside what was found.
  const std::vector<int> have = places_of(out.best.adopted, out.problem);
  for (const int c : places_of(fell, out.problem)) {
    double degrees = 0;
    if (further(out.form, out.problem, have, c, degrees).passes(degrees))
      out.ran_away.push_back(described(out.problem.candidates[static_cast<std::size_t>(c)]));
  }
  // Weigh sets of at most two causes (and the one found) at the model and noise found.
  const int n = static_cast<int>(out.problem.candidates.size());
  std::vector<std::vector<int>> sets{{}};
  const std::vector<int> found = places_of(out.best.adopted, out.problem);
  std::vector<std::pair<double, int>> singles;
  double common = 1;
  for (const Candidate& c : out.problem.candidates)
    if (std::ranges::any_of(out.best.adopted, [&](const Candidate& a) { return same(a, c); }))
      common = std::max(common, own_stretch(out.form, c));
  for (int c = 0; c < n; ++c) {
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
