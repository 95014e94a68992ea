// Starting values and noise for the fit of a model with other causes.
#include "ident/gap/hypotheses/next_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/stage_times.h"
#include "ident/effects/all_parameters.h"
#include "ident/flight/fit/fit_noise.h"

namespace ident {
namespace {

constexpr double kStrong = 1e4;  // beyond this fall of the cost noise is found anew with the cause

// A step of the quadratic form may end beyond what is physical: then half way there.
double within_limit(const FreeConstant& c, double value) {
  const double null = find_parameter(c.name)->null_value, limit = physical_limit(c);
  return std::abs(value - null) <= limit ? value : null + std::copysign(0.5 * limit, value - null);
}

// The constant of a new cause starts at the step of the quadratic form, where that has it. A payload's place
// follows from the centre of gravity that it moves.
void set_start(FreeConstant& c, const Candidate& cause, const ExtendedProblem& problem,
               const Eigen::VectorXd& step, const std::vector<double>& at, double reach) {
  for (const int i : cause.directions) {
    const FreeConstant& d = problem.constants[static_cast<std::size_t>(i)];
    const double moved = at[static_cast<std::size_t>(d.index)] + d.scale * step[i];
    if (d.name == c.name) c.start = within_limit(d, moved);
    if (c.name == "payload.m") c.start = std::max(c.start, 1e-3 * at[param::m]), c.positive = true;
    if (cause.name == "payload" && d.name.substr(0, 9) == "cg_offset" &&
        d.name.substr(9) == c.name.substr(7)) {
      const FreeConstant& carried = problem.constants[static_cast<std::size_t>(cause.directions[0])];
      const double mass = std::max(within_limit(carried, carried.scale * std::abs(step[cause.directions[0]])),
                                   1e-3 * at[param::m]);
      c.start = std::clamp(moved * at[param::m] / mass, -reach, reach);
    }
  }
}

// Motors so slow against what was stated that speeds as measured are the input, whatever is commanded.
bool ignores_commands(const FittedModel& model) {
  constexpr double kSlower = 20.0;
  const auto is_lag_of = [](const Candidate& c) { return c.name == "parameter:omega_m"; };
  if (std::ranges::any_of(model.adopted, is_lag_of)) return false;
  for (std::size_t i = 0; i < model.constants.size(); ++i)
    if (const FreeConstant& c = model.constants[i]; c.index == param::omega_m && c.prior_std)
      return model.theta->physical(model.fit.u, static_cast<int>(i)) < c.prior_value / kSlower;
  return false;
}

}  // namespace

Standing standing_at(const FlightRecord& record, const Vehicle& vehicle,
                     const std::vector<std::string>& exclude, FittedModel model) {
  Standing at{std::move(model), {}, {}, {}};
  at.problem = extended_problem(vehicle, at.model.theta->p(at.model.fit.u), record.signals,
                                at.model.constants, exclude);
  at.form = linearise_everything(record, at.model.fit, *at.model.theta, at.problem);
  at.have = places_of(at.model.adopted, at.problem);
  return at;
}

bool same(const Candidate& a, const Candidate& b) { return a.name == b.name && a.rotor == b.rotor; }

std::vector<int> places_of(const std::vector<Candidate>& causes, const ExtendedProblem& problem) {
  std::vector<int> places;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c)
    if (std::ranges::any_of(causes, [&](const Candidate& a) { return same(a, problem.candidates[c]); }))
      places.push_back(static_cast<int>(c));
  return places;
}

FittedModel with_causes(const FlightRecord& record, const Vehicle& vehicle, const Standing& at_now,
                        const std::vector<int>& causes, const FlightFitOptions& options) {
  const SetGain set = gain_of(at_now.form, at_now.problem, causes);
  std::vector<double> at = at_now.model.theta->p(at_now.model.fit.u);
  std::vector<FreeConstant> constants;
  for (FreeConstant c : at_now.model.constants) {
    c.start = at[static_cast<std::size_t>(c.index)];
    if (!c.adopted) constants.push_back(c);
  }
  std::vector<Candidate> adopted;
  for (const int chosen : causes) {
    const Candidate& cause = at_now.problem.candidates[static_cast<std::size_t>(chosen)];
    adopted.push_back(cause);
    for (FreeConstant c : constants_of(cause, vehicle, at, record.signals)) {
      if (std::ranges::find(constants, c.name, &FreeConstant::name) != constants.end()) continue;
      const auto had = std::ranges::find(at_now.model.constants, c.name, &FreeConstant::name);
      if (had != at_now.model.constants.end())
        c = *had, c.start = at[static_cast<std::size_t>(c.index)];
      else
        set_start(c, cause, at_now.problem, set.step, at, payload_reach(vehicle));
      c.adopted = true;
      constants.push_back(c);
    }
  }
  // What is dropped is not there.
  for (const FreeConstant& c : at_now.model.constants)
    if (c.adopted && std::ranges::find(constants, c.name, &FreeConstant::name) == constants.end())
      at[static_cast<std::size_t>(c.index)] = find_parameter(c.name)->null_value;
  FlightFitOptions again = options;
  // Under the noise that all causes together leave, one alone of several strong ones would bend the model:
  // then what is missing still passes for gusts.
  const bool strong = set.gain - gain_of(at_now.form, at_now.problem, at_now.have).gain > kStrong;
  again.noise = strong ? at_now.model.fit.noise : at_now.form.noise;
  again.estimate_noise = strong;
  again.near = at_now.model.fit.smoother;
  again.chunk_seconds = chunk_for(record, at_now.form.noise, again.fine_gusts);
  if (strong) again.chunk_seconds = std::min(again.chunk_seconds, at_now.model.fit.chunk_seconds);
  FittedModel found = fitted(constants, adopted, record, at, again);
  const bool cut_short = !found.fit.converged && found.fit.u.size() > 0;
  if (cut_short || (stands(found) && !ignores_commands(found))) return found;
  // What is missing had bent the model, and the step from there led astray: once more from what was stated,
  // and half the step.
  const auto is_new = [&](const FreeConstant& c) {
    return std::ranges::find(at_now.model.constants, c.name, &FreeConstant::name) ==
           at_now.model.constants.end();
  };
  for (FreeConstant& c : constants) {
    if (!c.adopted && c.prior_std) c.start = c.prior_value;
    if (const EffectParameter* effect = find_effect_parameter(c.name); effect && is_new(c) && !c.positive)
      c.start = 0.5 * (c.start + effect->null_value);
  }
  FittedModel other = fitted(std::move(constants), std::move(adopted), record, at, again);
  return stands(other) && !ignores_commands(other) ? other : found;
}

FittedModel with_lag_held(const std::vector<FreeConstant>& base, const FlightRecord& record,
                          const std::vector<double>& p, const FlightFitOptions& options) {
  const Stage stage("lag of the motors");
  std::vector<FreeConstant> held = base;
  for (FreeConstant& c : held)
    if ((c.index == param::omega_m || c.index == param::zeta_m) && c.prior_std) {
      *c.prior_std *= 0.03;
      know_alone(held, c.index);
    }
  FittedModel model = fitted(held, {}, record, p, options);
  model.constants = base;
  return model;
}

}  // namespace ident
