// Forward search with refits and exchange.
#include "ident/gap/model_search.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <utility>

#include "ident/core/error.h"
#include "ident/estimators/flight_hover.h"
#include "ident/gap/generic_rival.h"
#include "ident/gap/next_cause.h"
#include "ident/gap/wrong_lag.h"

namespace ident {
namespace {

// A cause gains this much, whatever its scatter, to be tried in full.
constexpr double kWorthATrial = 100.0;
// A model that misses much is good enough where so little of that is still to be had.
constexpr double kOfMisfit = 1e-4;
constexpr int kOften = 2;
constexpr std::size_t kTrials = 2;
// Causes found that are no more probable than this among all sets are exchanged, so often.
constexpr double kHardly = 0.3;
constexpr int kExchanges = 2;
// And one of two goes if they are no more probable than this with it.
constexpr double kAlmostNever = 0.03;
// Sets that are no less probable than this share of the one found are looked at in full, so many of them, and
// one is taken that leaves so little of what the one found leaves to others.
constexpr double kNotRuledOut = 1e-3;
constexpr std::size_t kAlternatives = 4;
constexpr double kLess = 0.9;
// What a regression predicts by more than chance, and the share of it that a missing cause leaves to it.
constexpr double kPredicted = 60.0;
constexpr double kMostOfIt = 0.5;
// Steps that a fit may take: what needs more has no minimum to speak of.
constexpr int kMostSteps = 40;
// Steps that the fit of another set may take; that of a right one takes three to seven.
constexpr int kAlternativeSteps = 12;

// One search: adds causes step by step, and exchanges them where their weights speak against them.
class Search {
 public:
  Search(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
         const SearchOptions& options)
      : record_(record), vehicle_(vehicle), p_(p), options_(options) {
    fit_.tolerance = 0.02;
    fit_.noise_rounds = 4;
    fit_.fine_gusts = false;   // sets are compared under a dispersion that is common to them
    fit_.choose_axes = false;  // a force that the model lacks would choose them
    fit_.exact = false;        // to a small share of a standard deviation is enough
    fit_.rough_noise = true;
    fit_.order = 3;
    fit_.most_steps = kMostSteps;
    fit_.tolerance_of_misfit = kOfMisfit;
  }

  SearchResult run() {
    begin();
    for (int left = kExchanges;; --left) {
      while (add_one() || let_go()) continue;
      if (left == 0 || !exchange()) break;
    }
    if (free_ && now_.model.adopted.empty()) base_is(std::move(*free_));
    add_plain_battery();
    // Those that still gain beside what was found.
    for (const int c : places_of(fell_, now_.problem))
      if (further(now_, now_.have, c).passes()) out_.ran_away.push_back(described(candidate(c)));
    out_.sets = weighed_sets(now_);
    out_.alone = steps_here();
    fit_.tolerance_of_misfit = 0;
    finish_fit(now_.model.fit, *now_.model.theta, fit_);
    out_.best = std::move(now_.model);
    out_.asked = asked_by_channels(out_.best);
    out_.problem = std::move(now_.problem), out_.form = std::move(now_.form);
    return std::move(out_);
  }

 private:
  // `further`: share of the search beyond the causes found so far.
  void tell(double further, const std::string& what) const {
    const double share = 0.15 * static_cast<double>(out_.steps.size()) + further;
    if (options_.progress) options_.progress(std::min(share, 0.85), what);
  }
  const Candidate& candidate(int c) const { return now_.problem.candidates[static_cast<std::size_t>(c)]; }
  Standing at(FittedModel model) const {
    return standing_at(record_, vehicle_, options_.exclude, std::move(model));
  }
  void adopt(const Candidate& cause, InFull next, double gain) {
    if (moves_mass(cause) && std::ranges::none_of(now_.model.adopted, moves_mass))
      before_mass_ = now_, steps_before_mass_ = out_.steps.size();
    out_.steps.push_back({described(cause), gain});
    now_ = std::move(next.at);
  }

  // The model as it is, with the motors' lag looked at first where it was pulled far.
  void begin() {
    tell(0.0, "the model as it is");
    std::vector<FreeConstant> base = free_constants(vehicle_, p_);
    if (!record_.signals.commands) leave_out_motors(base);
    if (options_.hover) hold_for_hover(base);
    FlightFitOptions patient = fit_;  // there is no other base
    patient.most_steps = 0;
    out_.base = fitted(base, {}, record_, p_, patient);
    if (!stands(out_.base))
      throw DataError("the model as it is cannot be fitted to these logs: simulations with it run away");
    fit_.order = out_.base.fit.smoother->order();
    tell(0.05, "every cause");
    now_ = at(out_.base);
    if (lag_pulled_far(out_.base)) {
      tell(0.1, "the motors' lag");
      if (auto lag = wrong_lag(record_, p_, out_.base, now_.problem, now_.form, fit_)) {
        out_.steps.push_back({described(lag->cause), lag->gain / own_stretch(now_.form, lag->cause)});
        kept_.push_back(lag->cause);
        out_.base_problem = now_.problem, out_.base_form = now_.form;
        now_ = at(std::move(lag->model));
        return;
      }
      // Speeds that a missing cause puts off their commands make the motors seem slow, and then no cause that
      // acts through the commands is seen: it is looked for at the lag stated.
      FlightFitOptions alike = fit_;
      alike.chunk_seconds = out_.base.fit.chunk_seconds;
      if (FittedModel held = with_lag_held(base, record_, p_, alike); stands(held))
        if (Standing there = at(std::move(held));
            shows_more(there, now_, cost_of_holding(record_, there, now_)))
          free_ = std::exchange(now_, std::move(there));
    }
    base_is(std::move(now_));
  }

  void base_is(Standing standing) {
    now_ = std::move(standing);
    out_.base = now_.model, out_.base_problem = now_.problem, out_.base_form = now_.form;
  }

  // Another model, of causes that were not added one by one.
  void move_to(Standing there) {
    now_ = std::move(there);
    before_mass_.reset();
    tried_.clear();
    out_.steps = steps_here();
  }

  bool add_one() {
    const bool as_many_as_asked = of_vehicle(now_.have) >= options_.most_causes;
    const auto barred = [&](int c) {
      const auto is_it = [&](const Candidate& t) { return same(t, candidate(c)); };
      return (as_many_as_asked && !is_of_mounting(candidate(c).name)) || std::ranges::any_of(fell_, is_it) ||
             std::ranges::any_of(dropped_, is_it);
    };
    const auto [best, uneven] = next_cause(now_, barred, tried_);
    // A delay or a lever arm, linearised where it is zero, gains most and yet looks uneven: it is judged
    // where it acts.
    if (uneven.gain > kWorthATrial && uneven.gain > 3 * best.gain && tried_.size() < kTrials) {
      if (try_uneven(uneven, best.honest()) || best.candidate < 0) return true;
    }
    if (best.candidate < 0) return false;
    const Candidate chosen = candidate(best.candidate);
    if (!explains_its_share(best, chosen)) return take_alternative() || take_where_it_acts(best, chosen);
    if (moves_mass(chosen) && take_payload_instead(chosen)) return true;
    tell(0.1, described(chosen));
    auto next = tried_in_full(record_, vehicle_, options_.exclude, now_, best.candidate, fit_);
    if (!next) {
      fell_.push_back(chosen);
      return true;
    }
    adopt(chosen, std::move(*next), best.honest());
    return true;
  }

  // False: tried, and no better where it acts than the best of the others.
  bool try_uneven(const Further& uneven, double others) {
    const Candidate cause = candidate(uneven.candidate);
    tell(0.05, described(cause));
    auto trial = tried_in_full(record_, vehicle_, options_.exclude, now_, uneven.candidate, fit_);
    if (!trial && uneven.possible) {
      fell_.push_back(cause);
      return true;
    }
    if (trial && trial->own.passes() && trial->own.honest() > others) {
      const double gain = trial->own.honest();
      adopt(cause, std::move(*trial), gain);
      return true;
    }
    tried_.push_back(cause);
    return false;
  }

  // One in the vehicle is measured against others there: by what they gained when they were found, or gain
  // now that the model is no longer bent in their place, for it may be no more than their form. How a sensor
  // is mounted is no form of anything.
  bool explains_its_share(const Further& next, const Candidate& cause) const {
    const bool mounting = is_of_mounting(cause.name);
    const auto sum = [&](const std::vector<SearchStep>& steps) {
      double gain = 0;
      for (const SearchStep& s : steps)
        if (mounting || !is_of_mounting(s.name)) gain += s.gain;
      return gain;
    };
    // Drag and what comes with it, wind that acts by it or rotors that flap as they drag, are one.
    const auto has = [&](std::initializer_list<const char*> names) {
      const auto is_it = [&](const Candidate& c) { return std::ranges::find(names, c.name) != names.end(); };
      return is_it(cause) || std::ranges::any_of(now_.model.adopted, is_it);
    };
    const bool in_one = has({"rotor_drag", "parasitic_drag"}) && has({"wind", "blade_flapping"});
    const int found = static_cast<int>(out_.steps.size()) - (in_one ? 1 : 0);
    const double gain = sum(out_.steps);
    return is_material(next, cause, found, found > 1 && !mounting ? std::max(gain, sum(steps_here())) : gain);
  }

  // One payload in place of all causes that move masses, `next` among them.
  bool take_payload_instead(const Candidate& next) {
    if (!before_mass_) return false;
    tell(0.1, "payload");
    std::vector<Candidate> moving{next};
    std::ranges::copy_if(now_.model.adopted, std::back_inserter(moving), moves_mass);
    // What else was found since stays.
    const auto others = std::ranges::count_if(now_.model.adopted, std::not_fn(moves_mass));
    const bool since = others > static_cast<std::ptrdiff_t>(before_mass_->have.size());
    auto payload =
        payload_instead(record_, vehicle_, options_.exclude, since ? now_ : *before_mass_, moving, fit_);
    before_mass_.reset();
    if (!payload) return false;
    if (since) {
      move_to(std::move(payload->at));
      return true;
    }
    out_.steps.resize(steps_before_mass_);
    const double gain = payload->own.honest();
    out_.steps.push_back({"payload", gain});
    now_ = std::move(payload->at);
    return true;
  }

  // Beside causes that are not of the catalogue the slow work of a battery passes for gusts, and gains too
  // little; the thrust itself shows it.
  void add_plain_battery() {
    out_.thrust = level_thrust(record_, p_);
    const auto is_it = [](const Candidate& c) { return c.name == "battery_sag"; };
    const auto battery = std::ranges::find_if(now_.problem.candidates, is_it);
    if (!out_.thrust.plain() || battery == now_.problem.candidates.end() ||
        std::ranges::any_of(now_.model.adopted, is_it))
      return;
    tell(0.1, battery->name);
    const auto c = static_cast<int>(battery - now_.problem.candidates.begin());
    if (auto next = tried_in_full(record_, vehicle_, options_.exclude, now_, c, fit_))
      adopt(Candidate(*battery), std::move(*next), further(now_, now_.have, c).honest());
  }

  // Motors whose lag was taken for wrong before anything else was known: not if with what was found since
  // they are as stated.
  bool let_go() {
    std::vector<int> others = now_.have;
    for (const int c : places_of(kept_, now_.problem)) std::erase(others, c);
    if (kept_.empty() || others.empty() || !lag_as_stated(now_.model)) return false;
    FittedModel model = with_causes(record_, vehicle_, now_, others, fit_);
    if (!stands(model)) return false;
    kept_.clear();
    move_to(at(std::move(model)));
    return true;
  }

  // Where the weights speak against the causes found: the set that they prefer, if they still do with it in
  // the model. What came first was chosen with the others missing.
  bool exchange() {
    if (now_.have.empty()) return false;
    const std::vector<int> kept = places_of(kept_, now_.problem);
    double all = 0, own = 0;
    const WeighedSet* best = nullptr;
    const std::vector<WeighedSet> sets = weighed_sets(now_);
    for (const WeighedSet& set : sets) {
      if (!std::ranges::includes(set.members, kept) || !may_be_tried(set.members)) continue;
      if (!best) best = &set;
      all += set.probability;
      if (std::ranges::includes(set.members, now_.have)) own += set.probability;
    }
    if (!best || own > kHardly * all) return false;
    // One of two that gains enough to be found stays unless the other does its work; a third that weighs
    // nothing goes.
    const bool drops = std::ranges::includes(now_.have, best->members);
    if (drops && static_cast<int>(now_.have.size()) <= kOften && own > kAlmostNever * all) return false;
    const std::vector<Candidate> before = now_.model.adopted;
    std::optional<Standing> preferred = preferred_in_full(best->members);
    if (!preferred) return false;
    Standing& there = *preferred;
    if (drops) {
      std::vector<int> gone = places_of(before, there.problem);
      std::erase_if(gone, [&](int c) { return std::ranges::find(there.have, c) != there.have.end(); });
      if (std::ranges::any_of(gone, [&](int c) { return further(there, there.have, c).passes(); }))
        return false;  // what it was adopted for is still there
      for (const int c : gone) dropped_.push_back(there.problem.candidates[static_cast<std::size_t>(c)]);
    }
    move_to(std::move(there));
    return true;
  }

  // The model with other causes, if all of them act there and the weights prefer them there, too.
  std::optional<Standing> preferred_in_full(const std::vector<int>& causes) {
    std::string names;
    for (const int c : causes) names += (names.empty() ? "" : ", ") + described(candidate(c));
    tell(0.1, names);
    FlightFitOptions brief = fit_;  // what flies as well as the set found is found as soon
    brief.most_steps = kAlternativeSteps;
    FittedModel model = with_causes(record_, vehicle_, now_, causes, brief);
    if (!stands(model)) return {};
    Standing there = at(std::move(model));
    const std::vector<int> before = places_of(now_.model.adopted, there.problem);
    if (there.have.size() != causes.size() || !(log_odds(there, there.have, before) > 0)) return {};
    return there;
  }

  // Strong causes are weighed far from where they act. Where those found leave something to others, sets of
  // as many that weigh little less are looked at in full.
  bool take_alternative() {
    const double left = left_to_others(now_);
    const std::vector<int> kept = places_of(kept_, now_.problem);
    const std::vector<WeighedSet> sets = weighed_sets(now_);
    const auto own = std::ranges::find(sets, now_.have, &WeighedSet::members);
    if (own == sets.end()) return false;
    for (const WeighedSet& set : sets) {
      if (looked_at_.size() >= kAlternatives || set.probability < kNotRuledOut * own->probability) break;
      std::vector<Candidate> causes;
      for (const int c : set.members) causes.push_back(candidate(c));
      if (set.members.size() != now_.have.size() || set.members == now_.have ||
          !std::ranges::includes(set.members, kept) || !may_be_tried(set.members) ||
          std::ranges::any_of(looked_at_, [&](const auto& l) { return std::ranges::equal(l, causes, same); }))
        continue;
      looked_at_.push_back(std::move(causes));
      std::optional<Standing> there = preferred_in_full(set.members);
      if (!there || left_to_others(*there) > kLess * left) continue;
      move_to(std::move(*there));
      return true;
    }
    return false;
  }

  // Beside a strong cause one that as linearised changes from one part of the flight to the next, or gains
  // too little, may do neither where it acts.
  bool take_where_it_acts(const Further& next, const Candidate& cause) {
    if (std::ranges::any_of(too_little_, [&](const Candidate& t) { return same(t, cause); })) return false;
    too_little_.push_back(cause);
    tell(0.1, described(cause));
    auto trial = tried_in_full(record_, vehicle_, options_.exclude, now_, next.candidate, fit_);
    if (!trial || !trial->own.passes()) return false;
    if (!explains_its_share(trial->own, cause) && !leaves_nothing_to_predict(trial->at)) return false;
    const double gain = trial->own.honest();
    adopt(cause, std::move(*trial), gain);
    return true;
  }

  // Beside a strong cause a true one is a small share of what is explained, and most of what is left: of what
  // a regression on the flight still predicts.
  bool leaves_nothing_to_predict(const Standing& there) const {
    const auto predicted = [&](const Standing& at) {
      return generic_rival(record_, *at.model.theta, at.model.fit, at.form.noise).total();
    };
    const double before = predicted(now_);
    return before > kPredicted && predicted(there) < kMostOfIt * before;
  }

  // The most that any further cause would explain.
  static double left_to_others(const Standing& at) {
    double left = 0;
    for (int c = 0; c < static_cast<int>(at.problem.candidates.size()); ++c)
      if (std::ranges::find(at.have, c) == at.have.end())
        if (const Further f = further(at, at.have, c); f.passes()) left = std::max(left, f.honest());
    return left;
  }

  // As many causes as were asked for, and none with which no model can be fitted.
  bool may_be_tried(const std::vector<int>& set) const {
    const auto fell = [&](int c) {
      return std::ranges::any_of(fell_, [&](const Candidate& f) { return same(f, candidate(c)); });
    };
    return of_vehicle(set) <= options_.most_causes && std::ranges::none_of(set, fell);
  }
  int of_vehicle(const std::vector<int>& set) const {
    return static_cast<int>(
        std::ranges::count_if(set, [&](int c) { return !is_of_mounting(candidate(c).name); }));
  }

  // What each cause found gains beside the others.
  std::vector<SearchStep> steps_here() const {
    std::vector<SearchStep> steps;
    for (const int c : now_.have) {
      std::vector<int> others = now_.have;
      std::erase(others, c);
      steps.push_back({described(candidate(c)), further(now_, others, c).honest()});
    }
    return steps;
  }

  const FlightRecord& record_;
  const Vehicle& vehicle_;
  const std::vector<double>& p_;
  const SearchOptions& options_;
  FlightFitOptions fit_;
  Standing now_;
  std::vector<Candidate> kept_;                    // found before all others, never exchanged
  std::vector<Candidate> tried_;                   // and found no better where they act
  std::vector<Candidate> fell_;                    // whose fit ran away
  std::vector<Candidate> dropped_;                 // the others do their work
  std::vector<Candidate> too_little_;              // explained, as linearised, and were tried in full
  std::vector<std::vector<Candidate>> looked_at_;  // in place of those found
  std::optional<Standing> free_;                   // the model as it is, where its lag was held
  std::optional<Standing> before_mass_;            // where no cause that moves masses was in the model
  std::size_t steps_before_mass_ = 0;
  SearchResult out_;
};

}  // namespace

SearchResult search_causes(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
                           const SearchOptions& options) {
  return Search(record, vehicle, p, options).run();
}

}  // namespace ident
