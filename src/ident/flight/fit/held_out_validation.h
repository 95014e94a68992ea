// Prediction of held-out flight by the refined constants and by those stated.
#pragma once

#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/prediction.h"

namespace ident {

/// Errors at one horizon, in noise standard deviations.
struct HorizonErrors {
  double horizon = 0.0;  ///< s
  PredictionSummary stated, refined;
};

struct Validation {
  std::vector<HorizonErrors> horizons;  ///< those with a window
  /// Whether the refined constants are worse than those stated at the shortest horizon, and better at none.
  bool worse = false;
  std::vector<PredictionWindow> stated_longest, refined_longest;  ///< windows of the longest horizon
};

/// Errors over 0.1, 0.5 and 1 s of `held_out`, by the constants at `before` and by those of the fit.
Validation validate_refined(const FlightRecord& held_out, const Theta& theta, const Eigen::VectorXd& before,
                            const FlightFit& fit);

}  // namespace ident
