// The end of a fit: minimum, covariance, and the constants by parts of the flight alone.
#pragma once

#include "ident/flight/fit/fit.h"

namespace ident {

/// Decrease of the cost that a step has to promise to be evaluated: the tolerance, or its share of the
/// misfit.
double worth_a_step(const FlightSmoother& smoother, const FlightFitOptions& options);

/// Takes a fit to its minimum, up to `options.tolerance`, and finds information and covariance there. A last
/// Newton step takes what is left and is not evaluated. An exact fit ends with fine steps, and with slopes in
/// double precision where the rounding of single precision would count as information. `at_minimum`: the fit
/// is at its minimum by slopes in single precision already.
void finish_fit(FlightFit& fit, const Theta& theta, const FlightFitOptions& options, bool at_minimum = false);

/// The shared unknowns from the first `training_share` of every arc alone: one Newton step from the fit.
Eigen::VectorXd fit_of_training(const FlightFit& fit, const FlightRecord& record, const Theta& theta,
                                double training_share);

/// Covariance of u from `draws` block bootstraps: blocks drawn with repetition, one Newton step from the fit
/// for each draw. The priors are drawn anew as well. Seeded.
Eigen::MatrixXd bootstrap_covariance(const FlightFit& fit, const Theta& theta, int draws);

}  // namespace ident
