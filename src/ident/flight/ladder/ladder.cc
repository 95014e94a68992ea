// Fits each rung to the first part of the flight, judges it on the rest, and fits it once more to all.
#include "ident/flight/ladder/ladder.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/all_parameters.h"
#include "ident/flight/ladder/constant_limits.h"
#include "ident/flight/ladder/paired_comparison.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

// Constants that no refinement may take out of their limits.
constexpr std::array kOfABody{param::m, param::kT, param::Jxx, param::Jyy, param::Jzz};
constexpr double kAbsent = 0.01;           // of an effect's usual size: it is not there
constexpr double kExplains = 0.7;          // of the error without a model: half of its square is explained
constexpr double kRefusedByChance = 0.05;  // probability, of a model that is as good as those below
constexpr double kLeastHeldOut = 1.5;      // s: a window of the longest horizon, and a second one

ErrorTable table_of(const std::vector<WindowErrors>& windows) {
  ErrorTable table;
  for (std::size_t m = 0; m < kMetrics; ++m)
    for (std::size_t h = 0; h < kLadderHorizons.size(); ++h)
      table[m][h] = error_of(windows, static_cast<Metric>(m), h);
  return table;
}

// A rung that is stood on: constants of both fits, its errors, and what it has estimated on either side.
struct Standing {
  std::size_t rung = 0;  // in the result
  std::vector<double> trained, whole;
  std::vector<WindowErrors> errors;
};

class Climb {
 public:
  Climb(const FlightRecord& record, LadderResult& result)
      : record_(record),
        training_(training_of(record, kTrainingShare)),
        held_out_(held_out_of(record, kTrainingShare)),
        whole_motion_(measured_motion(record_)),
        training_motion_(measured_motion(training_)),
        held_out_motion_(measured_motion(held_out_)),
        result_(result) {
    result_.seconds = held_out_.duration;
    result_.persistence = table_of(errors_of_persistence(held_out_motion_));
    stand(RungResult{.rung = Rung::stated, .p = record_.p}, record_.p);
  }

  const MeasuredMotion& motion() const { return whole_motion_; }
  bool judges() const { return result_.seconds > kLeastHeldOut && !held_out_motion_.arcs.empty(); }

  void fit(const RungModel& model) {
    std::vector<std::string>& names = model.what == FitTo::forces ? force_names_ : moment_names_;
    std::vector<std::string> with = names;
    with.insert(with.end(), model.constants.begin(), model.constants.end());
    const Standing& below = standing_.back();
    const Theta by_training = theta_of(below.trained, with), by_all = theta_of(below.whole, with);
    const std::vector<HeldConstant> held = held_beside(with, result_.rungs[below.rung]);
    const WindowFit trained = fit_windows(training_motion_, by_training, model.what, held),
                    whole = fit_windows(whole_motion_, by_all, model.what, held);
    RungResult rung{.rung = model.rung, .p = whole.p};
    take_over(rung, result_.rungs[below.rung], with);
    describe(rung, by_all, whole, by_training, trained);
    if (stand(std::move(rung), trained.p)) names = with;
  }

  void judge_full(const FullModel& full) {
    RungResult rung{.rung = Rung::full, .p = full.of_all};
    for (const FreeConstant& c : free_constants(*record_.vehicle, record_.p)) {
      if (!c.prior_std || std::ranges::none_of(kOfABody, [&](int of) { return of == c.index; })) continue;
      const double u = std::log(full.of_all[static_cast<std::size_t>(c.index)] / c.start);
      const auto [low, high] = limits_of(c);
      if (!(u >= low && u <= high)) rung.beyond.push_back(c.name);
    }
    stand(std::move(rung), full.of_training);
  }

 private:
  Theta theta_of(const std::vector<double>& p, const std::vector<std::string>& names) const {
    std::vector<std::string> also;
    for (const std::string& name : names)
      if (name.find('.') != std::string::npos) also.push_back(name);
    std::vector<FreeConstant> constants = free_constants(*record_.vehicle, p, also);
    std::erase_if(constants,
                  [&](const FreeConstant& c) { return std::ranges::find(names, c.name) == names.end(); });
    // Limits are those about what was stated, wherever the search starts.
    for (FreeConstant& c : constants) c.start = record_.p[static_cast<std::size_t>(c.index)];
    return {p, std::move(constants), record_.logs, false};
  }

  // Constants that were stated with a deviation and are not fitted, as well as they are known on the rung
  // below.
  std::vector<HeldConstant> held_beside(const std::vector<std::string>& names,
                                        const RungResult& below) const {
    std::vector<HeldConstant> out;
    for (const FreeConstant& c : free_constants(*record_.vehicle, record_.p)) {
      if (!c.prior_std || std::ranges::find(names, c.name) != names.end()) continue;
      const auto known = std::ranges::find(below.constants, c.name, &RungConstant::name);
      out.push_back({c.index, known == below.constants.end() ? *c.prior_std : known->std});
    }
    return out;
  }

  // What was estimated on the other side stays.
  static void take_over(RungResult& rung, const RungResult& below, const std::vector<std::string>& anew) {
    for (const RungConstant& c : below.constants)
      if (std::ranges::find(anew, c.name) == anew.end()) rung.constants.push_back(c);
    rung.correlation = below.correlation.part(
        [&](const std::string& name) { return std::ranges::find(anew, name) == anew.end(); });
  }

  // Constants with deviations, which have to bear what the two fits differ by.
  static void describe(RungResult& rung, const Theta& theta, const WindowFit& whole, const Theta& of_training,
                       const WindowFit& trained) {
    Correlation found;
    std::vector<Eigen::Index> at;
    for (int i = 0; i < theta.constants_count(); ++i) {
      const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
      const double value = theta.physical(whole.u, i);
      const bool effect = find_effect_parameter(c.name) != nullptr;
      if (effect && std::abs(value - default_value(c.name)) < kAbsent * c.scale) continue;
      const bool rotors = c.index == param::kQ || c.index == param::km;  // which nobody states well
      if (whole.at_limit[static_cast<std::size_t>(i)] && !rotors) rung.beyond.push_back(c.name);
      const double apart = value - of_training.physical(trained.u, i);
      const double std = std::hypot(theta.deviation(whole.u, i, whole.covariance), apart);
      rung.constants.push_back({c.name, value, std, c.prior_std, c.prior_value});
      found.names.push_back(c.name), at.push_back(i);
    }
    const Eigen::VectorXd s = whole.covariance.diagonal()(at).cwiseSqrt().cwiseInverse();
    found.matrix = s.asDiagonal() * Eigen::MatrixXd(whole.covariance(at, at)) * s.asDiagonal();
    rung.correlation = rung.correlation.empty() ? found : rung.correlation.beside(found);
  }

  // Judges a rung; whether it is stood on.
  bool stand(RungResult rung, std::vector<double> trained) {
    std::vector<WindowErrors> errors = held_out_errors(held_out_motion_, trained);
    rung.error = table_of(errors);
    if (!rung.beyond.empty()) rung.refusal = Refusal::beyond;
    if (rung.rung == Rung::inertia && !explains_rates(rung)) rung.refusal = Refusal::unexplained;
    refuse_where_worse(rung, errors);
    const bool good = rung.refusal == Refusal::none;
    if (good) {
      result_.chosen = result_.rungs.size();
      standing_.push_back({result_.chosen, std::move(trained), rung.p, std::move(errors)});
    }
    result_.rungs.push_back(std::move(rung));
    return good;
  }

  // Of the first tenth of a second, before what turns the vehicle is turned back.
  bool explains_rates(const RungResult& rung) const {
    const auto rate = static_cast<std::size_t>(Metric::rate);
    return rung.error[rate][0] < kExplains * result_.persistence[rate][0];
  }

  struct Comparison {
    const Standing* lower;
    Metric metric;
    std::size_t horizon;
  };

  // All errors in which the next rung is compared with one below it.
  std::vector<Comparison> comparisons() const {
    std::vector<Comparison> out;
    for (const Standing& lower : standing_)
      for (std::size_t m = 0; m < kMetrics; ++m)
        for (std::size_t h = 0; h < kLadderHorizons.size(); ++h) {
          const Metric metric = static_cast<Metric>(m);
          const double error = result_.rungs[lower.rung].error[m][h];
          if (metric == Metric::velocity || error < kExplains * result_.persistence[m][h])
            out.push_back({&lower, metric, h});
        }
    return out;
  }

  // All comparisons together refuse a right model with probability kRefusedByChance at most (Bonferroni).
  void refuse_where_worse(RungResult& rung, const std::vector<WindowErrors>& errors) const {
    const std::vector<Comparison> all = comparisons();
    const double level = kRefusedByChance / static_cast<double>(all.size());
    for (const auto& [lower, metric, horizon] : all) {
      if (rung.refusal != Refusal::none) return;
      if (!worse_beyond_chance(errors, lower->errors, metric, horizon, level)) continue;
      rung.refusal = Refusal::worse;
      rung.than = result_.rungs[lower->rung].rung, rung.metric = metric, rung.horizon = horizon;
    }
  }

  const FlightRecord& record_;
  FlightRecord training_, held_out_;
  MeasuredMotion whole_motion_, training_motion_, held_out_motion_;
  LadderResult& result_;
  std::vector<Standing> standing_;
  std::vector<std::string> force_names_, moment_names_;
};

}  // namespace

std::optional<LadderResult> climb_ladder(const FlightRecord& record, const std::optional<FullModel>& full) {
  LadderResult result;
  Climb climb(record, result);
  if (!climb.judges() || (!climb.motion().forces && !climb.motion().moments)) return {};
  for (const RungModel& model : rungs_for(climb.motion())) climb.fit(model);
  if (full) climb.judge_full(*full);
  const auto rate = static_cast<std::size_t>(Metric::rate);
  result.rotor_speeds = record.signals.rotor_speeds;
  result.moments_unexplained =
      climb.motion().moments && std::ranges::none_of(result.rungs, [&](const RungResult& rung) {
        return rung.error[rate][0] < kExplains * result.persistence[rate][0];
      });
  return result;
}

}  // namespace ident
