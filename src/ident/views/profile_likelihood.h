// Profile likelihood of constants that a flight hardly determines: is the interval that the curvature gives
// true further out?
#pragma once

#include <functional>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Twice the fall of the log likelihood, priors included, with one constant held off its optimum and all
/// others fitted anew; over the factor by which the colour of the residuals widens the interval, squared.
struct Profile {
  int constant = 0;                            ///< of theta
  std::vector<double> value;                   ///< in the constant's unit
  std::vector<double> fall;                    ///< NaN where the flight cannot be simulated
  std::vector<double> along, parabola, prior;  ///< values; what curvature promises there; the prior alone
};

/// Constants not identifiable or known only together with another (correlation above 0.95), weakest first.
std::vector<int> weak_constants(const FlightFit& fit, const std::vector<Parameter>& parameters);

/// At 1, 2 and 3 standard deviations on both sides: the others go where the quadratic form sends them, the
/// flight is linearised anew there and they make one Newton step; where that gains much it is evaluated too.
Profile profile_of(FlightSmoother& smoother, const FlightFit& fit, const Theta& theta, int constant);

/// Pictures of the profiles of the `most` weakest; no section when none is weak.
std::vector<Section> profile_sections(const FlightFit& fit, const Theta& theta,
                                      const std::vector<Parameter>& parameters, std::size_t most,
                                      const std::function<void(double)>& progress = {});

}  // namespace ident
