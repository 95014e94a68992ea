// A scan over omega_m, then the full fit from the best; and what other causes gain where the lag is held.
#include "ident/gap/search/wrong_lag.h"

#include <algorithm>
#include <cmath>

#include "ident/core/stage_times.h"
#include "ident/flight/record/excerpts.h"
#include "ident/gap/search/further.h"

namespace ident {
namespace {

constexpr double kPulledFar = 5.0;  // standard deviations
constexpr double kAsStated = 3.0;
constexpr double kSeen = 100.0;     // a cause that gains less is no reason to hold the lag
constexpr double kNoPhysics = 3.0;  // a factor that nothing missing in a model makes of a lag
constexpr double kSlowest = 2.0;    // rad/s: below it the commands no longer move the model's rotors
constexpr int kMostLagSteps = 20;   // of its fit: a right one takes five to twelve
constexpr double kEnough = 20.0, kStretch = 4.0;  // s of flight in which a wrong lag shows, in stretches
constexpr std::array kFactors = {1.0 / 27, 1.0 / 9, 1.0 / 3, 1.0 / 1.7, 1.7, 3.0, 9.0};

double total_cost(FlightSmoother& smoother, const Theta& theta, const Eigen::VectorXd& u) {
  const ReducedSystem& system = smoother.linearize(u);
  return std::isfinite(system.cost) ? system.cost + theta.prior(u).cost() : kNaN;
}

bool off(const FittedModel& model, int index, double deviations) {
  for (std::size_t i = 0; i < model.constants.size(); ++i) {
    const FreeConstant& c = model.constants[i];
    if (c.index != index || !c.prior_std) continue;
    const double value = model.theta->physical(model.fit.u, static_cast<int>(i));
    return std::abs(value - c.prior_value) > deviations * *c.prior_std;
  }
  return false;
}

// The stated value times a factor at which the flight fits best with all else as stated. NaN where it flies
// with none, or the slower the better: then no lag explains it, for the model does without its commands.
double best_start(const FlightRecord& record, const std::vector<double>& p, const NoiseModel& noise,
                  double chunk_seconds, Steps steps) {
  double best = kNaN, least = 1e300;
  for (const double factor : kFactors) {
    std::vector<double> there = p;
    there[param::omega_m] *= factor;
    const Theta theta(there, {}, record.logs, record.signals.rates);
    FlightSmoother smoother(record, theta, noise, chunk_seconds);
    smoother.set_steps(steps);
    const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
    smoother.settle(u, 2);
    const double cost = total_cost(smoother, theta, u);
    if (cost < least) least = cost, best = there[param::omega_m];
  }
  if (best == kFactors.front() * p[param::omega_m]) return kNaN;
  return best;
}

// Misfit of a flight under other noise, its states at their best.
double misfit(const FlightRecord& record, const FittedModel& model, const NoiseModel& noise) {
  FlightSmoother smoother(record, *model.theta, noise, model.fit.chunk_seconds);
  smoother.set_states(model.fit.smoother->states());
  smoother.set_steps(model.fit.smoother->steps());
  smoother.settle(model.fit.u, 2);
  return smoother.linearize(model.fit.u).cost;
}

}  // namespace

bool lag_beyond_physics(double found, double stated) {
  return std::max(found / stated, stated / found) >= kNoPhysics;
}

bool lag_pulled_far(const FittedModel& model) {
  return off(model, param::omega_m, kPulledFar) || off(model, param::zeta_m, kPulledFar);
}

bool lag_as_stated(const FittedModel& model) {
  return !off(model, param::omega_m, kAsStated) && !off(model, param::zeta_m, kAsStated);
}

std::optional<WrongLag> wrong_lag(const FlightRecord& record, const std::vector<double>& p,
                                  const FittedModel& at_hand, const ExtendedProblem& problem,
                                  const QuadraticForm& form, const FlightFitOptions& options) {
  const Stage stage("lag of the motors");
  const auto cause = std::ranges::find(problem.candidates, "parameter:omega_m", &Candidate::name);
  const auto adopted = [](const Candidate& c) { return c.name == "parameter:omega_m"; };
  if (cause == problem.candidates.end() || std::ranges::any_of(at_hand.adopted, adopted)) return {};
  if (!lag_pulled_far(at_hand)) return {};
  FlightFitOptions again = options;
  again.noise = form.noise, again.estimate_noise = false;
  again.chunk_seconds = at_hand.fit.chunk_seconds;
  again.most_steps = kMostLagSteps;
  std::vector<FreeConstant> constants = at_hand.constants;
  for (FreeConstant& c : constants) c.start = p[static_cast<std::size_t>(c.index)];
  FreeConstant& omega_m = constants[static_cast<std::size_t>(cause->parameter)];
  const auto lag_of = [&](const FittedModel& model) {
    return model.theta->physical(model.fit.u, cause->parameter);
  };
  const auto start_from = [&](const FittedModel& model) {
    for (std::size_t i = 0; i < constants.size(); ++i)
      constants[i].start = model.theta->physical(model.fit.u, static_cast<int>(i));
  };
  std::vector<Candidate> causes = at_hand.adopted;
  causes.push_back(*cause);
  // The model at hand may have come there by itself, against what was stated.
  const bool is_there = lag_beyond_physics(lag_of(at_hand), omega_m.prior_value);
  std::optional<FlightRecord> excerpt;
  if (record.duration > 2 * kEnough) excerpt = excerpt_of(record, kEnough / record.duration, kStretch);
  omega_m.start = best_start(excerpt ? *excerpt : record, p, form.noise, again.chunk_seconds, again.steps);
  if (!std::isfinite(omega_m.start)) return {};
  if (excerpt) {
    const FittedModel there = fitted(constants, causes, *excerpt, p, again);
    const bool wrong = stands(there) && lag_beyond_physics(lag_of(there), omega_m.prior_value);
    if (!wrong && !is_there) return {};
    if (wrong) start_from(there);
  }
  WrongLag out{*cause, fitted(constants, causes, record, p, again)};
  if (is_there) {
    start_from(at_hand);
    FittedModel on = fitted(constants, causes, record, p, again);
    if (stands(on) && (!stands(out.model) || on.fit.cost < out.model.fit.cost)) out.model = std::move(on);
  }
  if (!stands(out.model)) return {};
  FlightSmoother smoother(record, *at_hand.theta, form.noise, again.chunk_seconds);
  smoother.set_states(at_hand.fit.smoother->states());
  smoother.set_steps(at_hand.fit.smoother->steps());
  smoother.settle(at_hand.fit.u, 1);
  out.gain = total_cost(smoother, *at_hand.theta, at_hand.fit.u) - out.model.fit.cost;
  const double found = lag_of(out.model);
  if (!(out.gain > 0) || found < kSlowest || !lag_beyond_physics(found, omega_m.prior_value)) return {};
  return out;
}

bool shows_more(const Standing& held, const Standing& at_hand, double costs) {
  for (std::size_t c = 0; c < held.problem.candidates.size(); ++c) {
    const Candidate& cause = held.problem.candidates[c];
    const std::vector<int> there = places_of({cause}, at_hand.problem);
    if (is_lag(cause.name) || there.empty()) continue;
    const Further with = further(held, {}, static_cast<int>(c)), without = further(at_hand, {}, there[0]);
    if ((with.possible || with.beyond) && with.gain > kSeen && with.gain - without.gain > costs) return true;
  }
  return false;
}

double cost_of_holding(const FlightRecord& record, const Standing& held, const Standing& at_hand) {
  const Stage stage("lag of the motors");
  const NoiseModel& noise = held.form.noise;
  return misfit(record, held.model, noise) - misfit(record, at_hand.model, noise);
}

}  // namespace ident
