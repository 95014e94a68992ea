// Forward, backward, and across to the most probable set.
#include "ident/gap/windows/window_search.h"

#include <algorithm>

#include "ident/gap/search/next_cause.h"

namespace ident {
namespace {

constexpr int kMoves = 3;  // to another set, and trials for each: after that they go round in circles

class Search {
 public:
  Search(const WindowModel& model, const Vehicle& vehicle, const std::vector<double>& p,
         const std::vector<std::string>& exclude)
      : model_(model), vehicle_(vehicle), p_(p), exclude_(exclude), now_(with({})) {}

  WindowSearch run(int most) {
    WindowSearch out{{}, now_, {}};
    climb(most);
    for (int move = 0; move < kMoves && move_to_most_probable(); ++move) {
      const WindowStanding there = now_;
      climb(most);
      if (log_odds(now_.at, now_.at.have, places_of(there.at.model.adopted, now_.at.problem)) < 0) {
        now_ = there;
        break;
      }
    }
    out.best = now_;
    SearchResult& found = out.result;
    found.base = out.base.at.model, found.base_problem = out.base.at.problem,
    found.base_form = out.base.at.form;
    found.best = now_.at.model, found.problem = now_.at.problem, found.form = now_.at.form;
    found.sets = possible_sets();
    for (const int c : now_.at.have)
      found.steps.push_back({described(candidate(c)), beside_others(c).honest()});
    found.alone = found.steps;
    if (!exclude_.empty()) {
      const FittedModel& best = found.best;
      found.beside_left_out =
          beside_left_out(model_.standing(vehicle_, {}, best.constants, best.adopted, p_).at, exclude_);
    }
    found.thrust = level_thrust(model_.record(), p_);
    return out;
  }

 private:
  const Candidate& candidate(int c) const { return now_.at.problem.candidates[static_cast<std::size_t>(c)]; }

  WindowStanding with(std::vector<Candidate> causes) const {
    std::vector<FreeConstant> constants = free_constants(vehicle_, p_);
    for (const Candidate& cause : causes)
      for (FreeConstant c : constants_of(cause, vehicle_, p_, model_.record().signals)) {
        if (std::ranges::find(constants, c.name, &FreeConstant::name) != constants.end()) continue;
        c.adopted = true;
        constants.push_back(c);
      }
    return model_.standing(vehicle_, exclude_, std::move(constants), std::move(causes), p_);
  }

  Further beside_others(int c) const {
    std::vector<int> others = now_.at.have;
    std::erase(others, c);
    return further(now_.at, others, c);
  }

  void climb(int most) {
    while (static_cast<int>(now_.at.have.size()) < most) {
      const auto barred = [&](int c) {
        return std::ranges::any_of(fell_, [&](const Candidate& t) { return same(t, candidate(c)); });
      };
      const Further next = next_cause(now_.at, barred, {}).best;
      if (next.candidate < 0) return;
      std::vector<Candidate> causes = now_.at.model.adopted;
      const Candidate chosen = candidate(next.candidate);
      causes.push_back(chosen);
      WindowStanding there = with(std::move(causes));
      if (!stands(there.at.model)) {
        fell_.push_back(chosen);
        continue;
      }
      now_ = std::move(there);
      drop_idle();
      if (std::ranges::none_of(now_.at.model.adopted, [&](const Candidate& c) { return same(c, chosen); }))
        fell_.push_back(chosen);
    }
  }

  // Causes whose work the others do.
  void drop_idle() {
    for (;;) {
      const auto idle = std::ranges::find_if(now_.at.have, [&](int c) { return !beside_others(c).passes(); });
      if (idle == now_.at.have.end()) return;
      const Candidate gone = candidate(*idle);
      std::vector<Candidate> causes = now_.at.model.adopted;
      std::erase_if(causes, [&](const Candidate& c) { return same(c, gone); });
      now_ = with(std::move(causes));
    }
  }

  // To the most probable set of which a model stands; false where that is the one at hand.
  bool move_to_most_probable() {
    std::vector<int> have = now_.at.have;
    std::ranges::sort(have);
    int trials = 0;
    for (const WeighedSet& set : possible_sets()) {
      std::vector<int> members = set.members;
      std::ranges::sort(members);
      if (members == have || trials++ == kMoves) return false;
      std::vector<Candidate> causes;
      for (const int c : members) causes.push_back(candidate(c));
      WindowStanding there = with(causes);
      if (stands(there.at.model)) {
        now_ = std::move(there);
        return true;
      }
      fallen_.push_back(std::move(causes));
    }
    return false;
  }

  bool is_fallen(const std::vector<int>& set) const {
    return std::ranges::any_of(fallen_, [&](const std::vector<Candidate>& causes) {
      return causes.size() == set.size() && std::ranges::all_of(set, [&](int member) {
               return std::ranges::any_of(causes,
                                          [&](const Candidate& c) { return same(c, candidate(member)); });
             });
    });
  }

  // But for those that were tried and do not stand.
  std::vector<WeighedSet> possible_sets() const {
    std::vector<WeighedSet> sets = weighed_sets(now_.at);
    std::erase_if(sets, [&](const WeighedSet& set) { return is_fallen(set.members); });
    double sum = 0;
    for (const WeighedSet& set : sets) sum += set.probability;
    for (WeighedSet& set : sets) set.probability /= std::max(sum, 1e-300);
    return sets;
  }

  const WindowModel& model_;
  const Vehicle& vehicle_;
  const std::vector<double>& p_;
  const std::vector<std::string>& exclude_;
  WindowStanding now_;
  std::vector<Candidate> fell_;
  std::vector<std::vector<Candidate>> fallen_;  // sets
};

}  // namespace

WindowSearch search_windows(const WindowModel& model, const Vehicle& vehicle, const std::vector<double>& p,
                            const std::vector<std::string>& exclude, int most_causes) {
  return Search(model, vehicle, p, exclude).run(most_causes);
}

}  // namespace ident
