// One Newton step with the other input, with the states following.
#include "ident/flight/fit/input_sensitivity.h"

#include <algorithm>

#include "ident/flight/fit/fit_steps.h"

namespace ident {

bool has_noisy_input(const FlightRecord& record) {
  return std::ranges::any_of(record.arcs, [](const FlightArc& arc) {
    return arc.rougher != nullptr && arc.rougher->Omega != arc.inputs->Omega;
  });
}

Eigen::VectorXd moved_by_rougher_speeds(const FlightRecord& record, const Theta& theta,
                                        const FlightFit& fit) {
  if (!has_noisy_input(record)) return Eigen::VectorXd::Zero(fit.u.size());
  FlightRecord other = record;
  for (FlightArc& arc : other.arcs)
    if (arc.rougher) arc.inputs = arc.rougher;
  FlightSmoother smoother(other, theta, fit.noise, fit.chunk_seconds);
  smoother.set_huber(fit.smoother->huber());
  smoother.set_states(fit.smoother->states());
  smoother.settle(fit.u);
  linearize_at(smoother, fit.u);
  const Eigen::VectorXd du = newton_step(smoother, fit.u).du;
  return du.allFinite() ? du : Eigen::VectorXd::Zero(du.size());
}

Eigen::VectorXd moved_by_time(double seconds, const Theta& theta, const FlightFit& fit) {
  Eigen::VectorXd du = Eigen::VectorXd::Zero(fit.u.size());
  for (int i = 0; i < theta.constants_count(); ++i)
    if (theta.name(i) == "dead_time") du[i] = seconds / theta.slope(fit.u, i);
  return du;
}

}  // namespace ident
