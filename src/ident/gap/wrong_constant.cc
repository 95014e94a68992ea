// A scan over a constant's values, then the full fit from the best.
#include "ident/gap/wrong_constant.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr double kPulledFar = 5.0;  // standard deviations
constexpr double kNoPhysics = 3.0;  // a factor that nothing missing in a model makes of a constant
constexpr std::size_t kMost = 2;    // constants tried
constexpr std::array kFactors = {1.0 / 27, 1.0 / 9, 1.0 / 3, 1.0 / 1.7, 1.7, 3.0, 9.0};
constexpr double kMostDamping = 4.0;  // beyond it a motor is of first order: what is wrong is omega_m

double total_cost(FlightSmoother& smoother, const Theta& theta, const Eigen::VectorXd& u) {
  const ReducedSystem& system = smoother.linearize(u);
  if (!std::isfinite(system.cost)) return kNaN;
  return system.cost + theta.prior(u).residual.squaredNorm();
}

// Candidates whose constant the model at hand pulls far, furthest first.
std::vector<int> pulled(const FittedModel& at_hand, const ExtendedProblem& problem) {
  std::vector<std::pair<double, int>> far;
  for (std::size_t k = 0; k < problem.candidates.size(); ++k) {
    const Candidate& c = problem.candidates[k];
    if (c.parameter < 0) continue;
    const auto is_it = [&](const Candidate& a) { return a.name == c.name; };
    if (std::ranges::any_of(at_hand.adopted, is_it)) continue;
    const FreeConstant& of = at_hand.constants[static_cast<std::size_t>(c.parameter)];
    const double value = at_hand.theta->physical(at_hand.fit.u, c.parameter);
    const double pull = std::abs(value - of.prior_value) / of.prior_std.value_or(1e300);
    if (of.positive && pull > kPulledFar) far.emplace_back(-pull, static_cast<int>(k));
  }
  std::ranges::sort(far);
  std::vector<int> out;
  for (const auto& [pull, k] : far) out.push_back(k);
  out.resize(std::min(out.size(), kMost));
  return out;
}

// The stated value times a factor at which the flight fits best with all else as stated; NaN where it flies
// with none.
double best_start(const FlightRecord& record, const std::vector<double>& p,
                  const std::vector<FreeConstant>& constants, int which, const NoiseModel& noise,
                  double chunk_seconds) {
  double best = kNaN, least = 1e300;
  for (const double factor : kFactors) {
    std::vector<FreeConstant> there = constants;
    FreeConstant& c = there[static_cast<std::size_t>(which)];
    c.start *= factor, c.prior_std.reset();
    if (c.index == param::zeta_m && c.start > kMostDamping) continue;
    const Theta theta(p, there, record.logs, record.signals.rates);
    FlightSmoother smoother(record, theta, noise, chunk_seconds);
    const Eigen::VectorXd u = Eigen::VectorXd::Zero(theta.size());
    smoother.settle(u, 2);
    const double cost = total_cost(smoother, theta, u);
    if (cost < least) least = cost, best = c.start;
  }
  return best;
}

}  // namespace

WrongConstant wrong_constant(const FlightRecord& record, const std::vector<double>& p,
                             const FittedModel& at_hand, const ExtendedProblem& problem,
                             const QuadraticForm& form, const FlightFitOptions& options) {
  WrongConstant out;
  const std::vector<int> far = pulled(at_hand, problem);
  if (far.empty()) return out;
  FlightFitOptions again = options;
  again.noise = form.noise, again.estimate_noise = false;
  again.chunk_seconds = at_hand.fit.chunk_seconds;
  std::vector<FreeConstant> constants = at_hand.constants;
  for (FreeConstant& c : constants) c.start = p[static_cast<std::size_t>(c.index)];
  FlightSmoother smoother(record, *at_hand.theta, form.noise, again.chunk_seconds);
  smoother.set_states(at_hand.fit.smoother->states());
  smoother.settle(at_hand.fit.u, 1);
  const double cost = total_cost(smoother, *at_hand.theta, at_hand.fit.u);
  for (const int k : far) {
    const Candidate& cause = problem.candidates[static_cast<std::size_t>(k)];
    std::vector<FreeConstant> freed = constants;
    FreeConstant& c = freed[static_cast<std::size_t>(cause.parameter)];
    const double start = best_start(record, p, constants, cause.parameter, form.noise, again.chunk_seconds);
    if (!std::isfinite(start)) continue;
    c.start = start;
    std::vector<Candidate> adopted = at_hand.adopted;
    adopted.push_back(cause);
    FittedModel model = fitted(freed, adopted, record, p, again);
    if (!stands(model)) continue;
    if (c.index == param::zeta_m && model.theta->physical(model.fit.u, cause.parameter) > kMostDamping)
      continue;
    const double gain = cost - model.fit.cost;
    const double ratio = model.theta->physical(model.fit.u, cause.parameter) / c.prior_value;
    const bool beyond = std::max(ratio, 1 / ratio) > kNoPhysics;
    if (gain > out.gain) out = {k, std::move(model), gain, beyond};
  }
  return out;
}

}  // namespace ident
