// Forward search with refits and exchange.
#include "ident/gap/search/model_search.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/stage_times.h"
#include "ident/effects/cause_traits.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/gap/search/exchange_sets.h"
#include "ident/gap/search/next_cause.h"
#include "ident/gap/search/search_state.h"
#include "ident/gap/search/wrong_lag.h"
#include "ident/gap/statistics/generic_rival.h"

namespace ident {
namespace {

// A cause gains this much, whatever its scatter, to be tried in full.
constexpr double kWorthATrial = 100.0;
constexpr std::size_t kTrials = 2;
constexpr int kExchanges = 2;
// What a regression predicts by more than chance, and the share of it that a missing cause leaves to it.
constexpr double kPredicted = 60.0;
constexpr double kMostOfIt = 0.25;
// Fall of the cost that fine steps promise at the end of a search and that its last step may take unseen.
constexpr double kUnseen = 0.5;

// One search: adds causes step by step, and exchanges them where their weights speak against them.
class Search {
 public:
  Search(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
         const SearchOptions& options)
      : s_(record, vehicle, p, options) {}

  SearchResult run() {
    begin();
    for (int left = kExchanges;; --left) {
      while (add_one() || let_go()) continue;
      if (left == 0 || !exchange(s_)) break;
    }
    if (free_ && s_.now.model.adopted.empty()) base_is(std::move(*free_));
    add_plain_battery();
    // Those that still gain beside what was found.
    for (const int c : places_of(s_.fell, s_.now.problem))
      if (further(s_.now, s_.now.have, c).passes()) s_.out.ran_away.push_back(described(s_.candidate(c)));
    s_.out.sets = weighed_sets(s_.now);
    s_.out.alone = s_.steps_here();
    if (const std::vector<std::string>& left_out = s_.options.exclude; !left_out.empty())
      s_.out.beside_left_out =
          beside_left_out(standing_at(s_.record, s_.vehicle, {}, s_.now.model), left_out);
    s_.fit.tolerance_of_misfit = 0, s_.fit.tolerance = kUnseen;
    s_.now.model.fit.smoother->set_steps(Steps::fine);
    finish_fit(s_.now.model.fit, *s_.now.model.theta, s_.fit);
    s_.now.model.fit.smoother->set_steps(s_.fit.steps);  // for what is asked of the end
    s_.out.best = std::move(s_.now.model);
    s_.out.asked = asked_by_channels(s_.out.best);
    s_.out.problem = std::move(s_.now.problem), s_.out.form = std::move(s_.now.form);
    return std::move(s_.out);
  }

 private:
  void adopt(const Candidate& cause, InFull next, double gain) {
    if (moves_mass(cause) && std::ranges::none_of(s_.now.model.adopted, moves_mass))
      s_.before_mass = s_.now, steps_before_mass_ = s_.out.steps.size();
    s_.out.steps.push_back({described(cause), gain});
    s_.now = std::move(next.at);
  }

  // The model as it is, with the motors' lag looked at first where it was pulled far.
  void begin() {
    s_.tell(0.0, "the model as it is");
    std::vector<FreeConstant> base = free_constants(s_.vehicle, s_.p);
    if (!s_.record.signals.commands) leave_out_motors(base);
    if (s_.options.hover) hold_for_hover(base, Held::unstated);
    FlightFitOptions patient = s_.fit;  // there is no other base
    patient.most_steps = 0;
    s_.out.base = fitted(base, {}, s_.record, s_.p, patient);
    if (!stands(s_.out.base))
      throw DataError("the model as it is cannot be fitted to these logs: simulations with it run away");
    s_.fit.steps = s_.out.base.fit.smoother->steps();
    s_.tell(0.05, "every cause");
    s_.now = s_.at(s_.out.base);
    if (lag_pulled_far(s_.out.base)) {
      s_.tell(0.1, "the motors' lag");
      if (auto lag = wrong_lag(s_.record, s_.p, s_.out.base, s_.now.problem, s_.now.form, s_.fit)) {
        s_.out.steps.push_back({described(lag->cause), lag->gain / own_stretch(s_.now.form, lag->cause)});
        s_.kept.push_back(lag->cause);
        s_.out.base_problem = s_.now.problem, s_.out.base_form = s_.now.form;
        s_.now = s_.at(std::move(lag->model));
        return;
      }
      // Speeds that a missing cause puts off their commands make the motors seem slow, and then no cause that
      // acts through the commands is seen: it is looked for at the lag stated.
      FlightFitOptions alike = s_.fit;
      alike.chunk_seconds = s_.out.base.fit.chunk_seconds;
      if (FittedModel held = with_lag_held(base, s_.record, s_.p, alike); stands(held))
        if (Standing there = s_.at(std::move(held));
            shows_more(there, s_.now, cost_of_holding(s_.record, there, s_.now)))
          free_ = std::exchange(s_.now, std::move(there));
    }
    base_is(std::move(s_.now));
  }

  void base_is(Standing standing) {
    s_.now = std::move(standing);
    s_.out.base = s_.now.model, s_.out.base_problem = s_.now.problem, s_.out.base_form = s_.now.form;
  }

  bool add_one() {
    const bool as_many_as_asked = s_.of_vehicle(s_.now.have) >= s_.options.most_causes;
    const auto barred = [&](int c) {
      const auto is_it = [&](const Candidate& t) { return same(t, s_.candidate(c)); };
      return (as_many_as_asked && !is_of_mounting(s_.candidate(c).name)) ||
             std::ranges::any_of(s_.fell, is_it) || std::ranges::any_of(s_.dropped, is_it);
    };
    const auto [best, uneven] = next_cause(s_.now, barred, s_.tried);
    // A delay or a lever arm, linearised where it is zero, gains most and yet looks uneven: it is judged
    // where it acts.
    if (uneven.gain > kWorthATrial && uneven.gain > 3 * best.gain && s_.tried.size() < kTrials) {
      if (try_uneven(uneven, best.honest()) || best.candidate < 0) return true;
    }
    if (best.candidate < 0) return false;
    const Candidate chosen = s_.candidate(best.candidate);
    if (!explains_its_share(best, chosen))
      return take_alternative(s_, looked_at_) || take_where_it_acts(best, chosen);
    if (moves_mass(chosen) && take_payload_instead(chosen)) return true;
    s_.tell(0.1, described(chosen));
    auto next = tried_in_full(s_.record, s_.vehicle, s_.options.exclude, s_.now, best.candidate, s_.fit);
    if (!next) {
      s_.fell.push_back(chosen);
      return true;
    }
    adopt(chosen, std::move(*next), best.honest());
    return true;
  }

  // False: tried, and no better where it acts than the best of the others.
  bool try_uneven(const Further& uneven, double others) {
    const Candidate cause = s_.candidate(uneven.candidate);
    s_.tell(0.05, described(cause));
    auto trial = tried_in_full(s_.record, s_.vehicle, s_.options.exclude, s_.now, uneven.candidate, s_.fit);
    if (!trial && uneven.possible) {
      s_.fell.push_back(cause);
      return true;
    }
    if (trial && ((trial->own.passes() && trial->own.honest() > others) ||
                  (trial->own.possible && leaves_little_to_predict(trial->at)))) {
      const double gain = trial->own.honest();
      adopt(cause, std::move(*trial), gain);
      return true;
    }
    s_.tried.push_back(cause);
    return false;
  }

  // One in the vehicle is measured against others there: by what they gained when they were found, or gain
  // now that the model is no longer bent in their place, for it may be no more than their form. How a sensor
  // is mounted is no form of anything.
  bool explains_its_share(const Further& next, const Candidate& cause) const {
    const bool mounting = is_of_mounting(cause.name);
    const auto counts = [&](const SearchStep& step) { return mounting || !is_of_mounting(step.name); };
    const auto sum = [&](const std::vector<SearchStep>& steps) {
      double gain = 0;
      for (const SearchStep& s : steps)
        if (counts(s)) gain += s.gain;
      return gain;
    };
    // Drag and what comes with it, wind that acts by it or rotors that flap as they drag, are one.
    const auto is_one_with = [](const Candidate& a, const Candidate& b) {
      return traits_of(b.name).carries_air && (traits_of(a.name).by_the_air || implies(a.name, b.name));
    };
    const bool in_one = std::ranges::any_of(s_.now.model.adopted, [&](const Candidate& c) {
      return is_one_with(c, cause) || is_one_with(cause, c);
    });
    const int found = static_cast<int>(std::ranges::count_if(s_.out.steps, counts)) - (in_one ? 1 : 0);
    const double gain = sum(s_.out.steps);
    return is_material(next, cause, found,
                       found > 1 && !mounting ? std::max(gain, sum(s_.steps_here())) : gain);
  }

  // One payload in place of all causes that move masses, `next` among them.
  bool take_payload_instead(const Candidate& next) {
    if (!s_.before_mass) return false;
    s_.tell(0.1, "payload");
    std::vector<Candidate> moving{next};
    std::ranges::copy_if(s_.now.model.adopted, std::back_inserter(moving), moves_mass);
    // What else was found since stays.
    const auto others = std::ranges::count_if(s_.now.model.adopted, std::not_fn(moves_mass));
    const bool since = others > static_cast<std::ptrdiff_t>(s_.before_mass->have.size());
    auto payload = payload_instead(s_.record, s_.vehicle, s_.options.exclude,
                                   since ? s_.now : *s_.before_mass, moving, s_.fit);
    s_.before_mass.reset();
    if (!payload) return false;
    if (since) {
      s_.move_to(std::move(payload->at));
      return true;
    }
    s_.out.steps.resize(steps_before_mass_);
    const double gain = payload->own.honest();
    s_.out.steps.push_back({"payload", gain});
    s_.now = std::move(payload->at);
    return true;
  }

  // Beside causes that are not of the catalogue the slow work of a battery passes for gusts, and gains too
  // little; the thrust itself shows it.
  void add_plain_battery() {
    s_.out.thrust = level_thrust(s_.record, s_.p);
    const auto is_it = [](const Candidate& c) { return traits_of(c.name).of_battery; };
    const auto battery = std::ranges::find_if(s_.now.problem.candidates, is_it);
    if (!s_.out.thrust.plain() || battery == s_.now.problem.candidates.end() ||
        std::ranges::any_of(s_.now.model.adopted, is_it))
      return;
    s_.tell(0.1, battery->name);
    const auto c = static_cast<int>(battery - s_.now.problem.candidates.begin());
    if (auto next = tried_in_full(s_.record, s_.vehicle, s_.options.exclude, s_.now, c, s_.fit))
      adopt(Candidate(*battery), std::move(*next), further(s_.now, s_.now.have, c).honest());
  }

  // Motors whose lag was taken for wrong before anything else was known: not if with what was found since
  // they are as stated.
  bool let_go() {
    std::vector<int> others = s_.now.have;
    for (const int c : places_of(s_.kept, s_.now.problem)) std::erase(others, c);
    if (s_.kept.empty() || others.empty() || !lag_as_stated(s_.now.model)) return false;
    FittedModel model = with_causes(s_.record, s_.vehicle, s_.now, others, s_.fit);
    if (!stands(model)) return false;
    s_.kept.clear();
    s_.move_to(s_.at(std::move(model)));
    return true;
  }

  // Beside a strong cause one that as linearised changes from one part of the flight to the next, or gains
  // too little, may do neither where it acts.
  bool take_where_it_acts(const Further& next, const Candidate& cause) {
    if (std::ranges::any_of(too_little_, [&](const Candidate& t) { return same(t, cause); })) return false;
    too_little_.push_back(cause);
    s_.tell(0.1, described(cause));
    auto trial = tried_in_full(s_.record, s_.vehicle, s_.options.exclude, s_.now, next.candidate, s_.fit);
    if (!trial || !trial->own.passes()) return false;
    if (!explains_its_share(trial->own, cause) && !leaves_little_to_predict(trial->at)) return false;
    const double gain = trial->own.honest();
    adopt(cause, std::move(*trial), gain);
    return true;
  }

  // Beside a strong cause a true one is a small share of what is explained, and most of what is left: of what
  // a regression on the flight still predicts.
  bool leaves_little_to_predict(const Standing& there) {
    const auto left = [&](const Standing& at) {
      return generic_rival(s_.record, *at.model.theta, at.model.fit, s_.now.form.noise);
    };
    if (predicted_of_ != s_.now.model.fit.smoother) predicted_ = left(s_.now).total();
    predicted_of_ = s_.now.model.fit.smoother;
    if (!(predicted_ > kPredicted)) return false;
    const Rival after = left(there);
    return after.judged && after.total() < kMostOfIt * predicted_;
  }

  SearchState s_;
  std::vector<Candidate> too_little_;  // explained, as linearised, and were tried in full
  LookedAt looked_at_;
  std::optional<Standing> free_;  // the model as it is, where its lag was held
  std::size_t steps_before_mass_ = 0;
  double predicted_ = 0;  // by a regression on the flight, of what this model leaves
  std::shared_ptr<FlightSmoother> predicted_of_;
};

}  // namespace

SearchResult search_causes(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
                           const SearchOptions& options) {
  const Stage stage("search");
  return Search(record, vehicle, p, options).run();
}

}  // namespace ident
