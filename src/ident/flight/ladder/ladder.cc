// Fits each rung to the first part of the flight, judges it on the rest, and fits it once more to all.
#include "ident/flight/ladder/ladder.h"

#include <algorithm>
#include <cmath>

#include "ident/core/parallel.h"
#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"
#include "ident/flight/ladder/constant_limits.h"
#include "ident/flight/ladder/paired_comparison.h"
#include "ident/flight/record/excerpts.h"

namespace ident {
namespace {

// Constants that no refinement may take out of their limits.
constexpr std::array kOfABody{param::m, param::kT, param::Jxx, param::Jyy, param::Jzz};
constexpr std::array kInertia{param::Jxx, param::Jyy, param::Jzz};
constexpr std::array kTurning{param::Jxx, param::Jyy, param::Jzz, param::kQ};
constexpr double kAbsent = 0.01;           // of an effect's usual size: it is not there
constexpr double kRefusedByChance = 0.05;  // probability, of a model that is as good as those below
constexpr double kLeastHeldOut = 1.5;      // s: a window of the longest horizon, and a second one

ErrorTable table_of(const std::vector<WindowErrors>& windows) {
  ErrorTable table;
  for (std::size_t m = 0; m < kMetrics; ++m)
    for (std::size_t h = 0; h < kLadderHorizons.size(); ++h)
      table[m][h] = error_of(windows, static_cast<Metric>(m), h);
  return table;
}

// Judges rungs by held-out flight, against all that are stood on.
class Judge {
 public:
  Judge(const FlightRecord& record, LadderResult& result)
      : held_out_(held_out_of(record, kTrainingShare)), motion_(measured_motion(held_out_)), result_(result) {
    for (std::size_t r = 0; r < result.rungs.size(); ++r)
      if (result.rungs[r].refusal == Refusal::none)
        standing_.push_back({r, held_out_errors(motion_, result.rungs[r].trained)});
  }

  bool can() const { return held_out_.duration > kLeastHeldOut && !motion_.arcs.empty(); }

  void begin() {
    result_.seconds = held_out_.duration, result_.persistence = table_of(errors_of_persistence(motion_));
  }

  // Whether the rung is stood on, and by what it was fitted to: rotor speeds by themselves, the rest by all.
  bool stand(RungResult rung, FitTo what) {
    std::vector<WindowErrors> errors = held_out_errors(motion_, rung.trained);
    rung.error = table_of(errors);
    if (!rung.beyond.empty()) rung.refusal = Refusal::beyond;
    if (rung.rung == Rung::inertia && !explains_rates(rung)) rung.refusal = Refusal::unexplained;
    refuse_where_worse(rung, errors, what);
    const bool good = rung.refusal == Refusal::none;
    if (good) {
      result_.chosen = result_.rungs.size();
      standing_.push_back({result_.chosen, std::move(errors)});
    }
    result_.rungs.push_back(std::move(rung));
    return good;
  }

  // Motors as they are may predict worse beside a thrust that is not: what is taken in the end is worse in
  // nothing than what is below it.
  void settle() {
    while (result_.chosen > 0) {
      const Standing highest = std::move(standing_.back());
      standing_.pop_back();
      RungResult& rung = result_.rungs[highest.rung];
      refuse_where_worse(rung, highest.errors, FitTo::forces);
      if (rung.refusal == Refusal::none) return;
      result_.chosen = standing_.back().rung;
    }
  }

  // Of the first tenth of a second, before what turns the vehicle is turned back.
  bool explains_rates(const RungResult& rung) const {
    const auto rate = static_cast<std::size_t>(Metric::rate);
    return rung.error[rate][0] < kExplains * result_.persistence[rate][0];
  }

 private:
  struct Standing {
    std::size_t rung = 0;  // in the result
    std::vector<WindowErrors> errors;
  };

  struct Comparison {
    const Standing* lower;
    Metric metric;
    std::size_t horizon;
  };

  // All errors in which the next rung is compared with one below it.
  std::vector<Comparison> comparisons(FitTo what) const {
    std::vector<Comparison> out;
    for (const Standing& lower : standing_)
      for (std::size_t m = 0; m < kMetrics; ++m)
        for (std::size_t h = 0; h < kLadderHorizons.size(); ++h) {
          const Metric metric = static_cast<Metric>(m);
          if (what == FitTo::speeds && metric != Metric::rotor_speed) continue;
          const double error = result_.rungs[lower.rung].error[m][h];
          if (metric == Metric::velocity || error < kExplains * result_.persistence[m][h])
            out.push_back({&lower, metric, h});
        }
    return out;
  }

  // All comparisons together refuse a right model with probability kRefusedByChance at most (Bonferroni).
  void refuse_where_worse(RungResult& rung, const std::vector<WindowErrors>& errors, FitTo what) const {
    const std::vector<Comparison> all = comparisons(what);
    const double level = kRefusedByChance / static_cast<double>(all.size());
    for (const auto& [lower, metric, horizon] : all) {
      if (rung.refusal != Refusal::none) return;
      if (!worse_beyond_chance(errors, lower->errors, metric, horizon, level)) continue;
      rung.refusal = Refusal::worse;
      rung.than = result_.rungs[lower->rung].rung, rung.metric = metric, rung.horizon = horizon;
    }
  }

  FlightRecord held_out_;
  MeasuredMotion motion_;
  LadderResult& result_;
  std::vector<Standing> standing_;
};

// Fits rungs, each upon the highest that is stood on.
class Climb {
 public:
  Climb(const FlightRecord& record, LadderResult& result, Judge& judge)
      : record_(record),
        training_(training_of(record, kTrainingShare)),
        whole_motion_(measured_motion(record_)),
        training_motion_(measured_motion(training_)),
        result_(result),
        judge_(judge) {}

  const MeasuredMotion& motion() const { return whole_motion_; }

  void fit(const RungModel& model) {
    std::vector<std::string>& names = names_[static_cast<std::size_t>(model.what)];
    std::vector<std::string> with = names;
    with.insert(with.end(), model.constants.begin(), model.constants.end());
    const RungResult below = result_.rungs[result_.chosen];  // a copy: rungs are added
    const Theta by_training = theta_of(below.trained, with), by_all = theta_of(below.p, with);
    // Of the fit to a part only the values count.
    WindowFit trained, whole;
    in_parallel(2, [&](std::size_t of) {
      if (of == 0)
        whole = fit_windows(whole_motion_, by_all, model.what, held_beside(with, below), below.p);
      else
        trained = fit_windows(training_motion_, by_training, model.what, {}, below.trained);
    });
    RungResult rung{.rung = model.rung, .p = whole.p, .trained = trained.p};
    take_over(rung, below, with);
    describe(rung, model.what, by_all, whole, by_training, trained);
    if (judge_.stand(rung, model.what) ||
        (model.what == FitTo::forces && stands_turning_as(below, std::move(rung))))
      names = with;
  }

 private:
  // Forces tell nothing of inertia, and a thrust that was stated wrong has an inertia beside it that makes up
  // for it: a rung that was refused for how it turns is tried once more with moments over inertia as below.
  bool stands_turning_as(const RungResult& below, RungResult rung) {
    const RungResult& refused = result_.rungs.back();
    if (refused.refusal != Refusal::worse || refused.metric == Metric::velocity) return false;
    const std::vector<double> from = below.p, from_trained = below.trained;
    result_.rungs.pop_back();
    keep_turning(from, rung.p), keep_turning(from_trained, rung.trained);
    for (const FreeConstant& c : free_constants(*record_.vehicle, record_.p)) {
      if (std::ranges::none_of(kTurning, [&](int k) { return k == c.index; }) || !c.prior_std) continue;
      std::erase_if(rung.constants, [&](const RungConstant& known) { return known.name == c.name; });
      const double value = rung.p[static_cast<std::size_t>(c.index)];
      rung.constants.push_back({c.name, value, *c.prior_std * value / c.start, c.prior_std, c.prior_value});
    }
    return judge_.stand(std::move(rung), FitTo::forces);
  }

  // All of the inertia goes with the thrust, so that what turns the vehicle by itself, w x J w, stays too;
  // and the torque of the rotors with it.
  void keep_turning(const std::vector<double>& from, std::vector<double>& p) const {
    const bool by_commands = record_.signals.commands && !record_.signals.rotor_speeds;
    const double speed = by_commands ? std::pow(p[param::km] / from[param::km], 2) : 1.0;
    const double thrust = p[param::kT] / from[param::kT];
    for (const int J : kInertia)
      p[static_cast<std::size_t>(J)] = from[static_cast<std::size_t>(J)] * speed * thrust;
    p[param::kQ] = from[param::kQ] * thrust;
  }

  Theta theta_of(const std::vector<double>& p, const std::vector<std::string>& names) const {
    // What a vehicle file need not state.
    std::vector<std::string> also;
    for (const std::string& name : names)
      if (name.find('.') != std::string::npos || name == "Omega_0") also.push_back(name);
    std::erase_if(also, [&](const std::string& name) {
      return record_.vehicle->has(name) && record_.vehicle->parameters.at(name).std == 0.0;
    });
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
  static void describe(RungResult& rung, FitTo what, const Theta& theta, const WindowFit& whole,
                       const Theta& of_training, const WindowFit& trained) {
    Correlation found;
    std::vector<Eigen::Index> at;
    for (int i = 0; i < theta.constants_count(); ++i) {
      const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
      const double value = theta.physical(whole.u, i);
      const bool effect = find_effect_parameter(c.name) != nullptr;
      if (effect && std::abs(value - default_value(c.name)) < kAbsent * c.scale) continue;
      // Which nobody states well; a command may be linear in the thrust, and the curve then at its limit.
      const bool rotors = c.index == param::kQ || c.index == param::km || rung.rung == Rung::curve;
      if (whole.at_limit[static_cast<std::size_t>(i)] && !rotors) rung.beyond.push_back(c.name);
      const double apart = value - of_training.physical(trained.u, i);
      const double std = std::hypot(theta.deviation(whole.u, i, whole.covariance), apart);
      rung.constants.push_back({c.name, value, std, c.prior_std, c.prior_value, what});
      found.names.push_back(c.name), at.push_back(i);
    }
    const Eigen::VectorXd s = whole.covariance.diagonal()(at).cwiseSqrt().cwiseInverse();
    found.matrix = s.asDiagonal() * Eigen::MatrixXd(whole.covariance(at, at)) * s.asDiagonal();
    rung.correlation = rung.correlation.empty() ? found : rung.correlation.beside(found);
  }

  const FlightRecord& record_;
  FlightRecord training_;
  MeasuredMotion whole_motion_, training_motion_;
  LadderResult& result_;
  Judge& judge_;
  std::array<std::vector<std::string>, 3> names_;  // that are fitted on each side
};

}  // namespace

std::optional<LadderResult> climb_ladder(const FlightRecord& record) {
  const Stage stage("ladder of plain models");
  LadderResult result;
  Judge judge(record, result);
  Climb climb(record, result, judge);
  const MeasuredMotion& motion = climb.motion();
  if (!judge.can() || (!motion.forces && !motion.moments)) return {};
  judge.begin();
  judge.stand(RungResult{.rung = Rung::stated, .p = record.p, .trained = record.p}, FitTo::forces);
  for (const RungModel& model : rungs_for(motion)) climb.fit(model);
  judge.settle();
  result.rotor_speeds = record.signals.rotor_speeds;
  const auto explains = [&](const RungResult& rung) { return judge.explains_rates(rung); };
  result.moments_unexplained = motion.moments && std::ranges::none_of(result.rungs, explains);
  const bool confirmed = record.signals.commands && record.signals.rotor_speeds;
  result.misses_turning = result.moments_unexplained && !confirmed;
  return result;
}

void judge_full(LadderResult& ladder, const FlightRecord& record, const FullModel& full) {
  RungResult rung{.rung = Rung::full, .p = full.of_all, .trained = full.of_training};
  for (const FreeConstant& c : free_constants(*record.vehicle, record.p)) {
    if (!c.prior_std || std::ranges::none_of(kOfABody, [&](int of) { return of == c.index; })) continue;
    const double u = std::log(full.of_all[static_cast<std::size_t>(c.index)] / c.start);
    const auto [low, high] = limits_of(c);
    if (!(u >= low && u <= high)) rung.beyond.push_back(c.name);
  }
  Judge judge(record, ladder);
  judge.stand(std::move(rung), FitTo::forces);
  ladder.moments_unexplained = ladder.moments_unexplained && !judge.explains_rates(ladder.rungs.back());
}

}  // namespace ident
