// How far speeds on their way between plateaus are from the motor's equation, against settled ones.
//
// No motor obeys its equation to the noise of a good speed sensor. With the noise of plateaus as scale whole
// transients would be outliers, and nothing would hold the fit. Where transients are off beyond noise the fit
// is therefore plain least squares, and its deviations come from the residuals themselves:
//
//     C = C_0 + H (sum_i r_i^2 J_i J_i') H (1 + rho)/(1 - rho) ,   H = C_0/sigma^2                        (1)
//
// with C_0 the covariance for white residuals of equal size sigma, J_i the derivatives of row i, rho the
// correlation of neighbouring residuals [White 1980; the factor is that of an autoregressive series].
#pragma once

#include <span>
#include <vector>

#include "ident/bench/motor/motor_step_record.h"

namespace ident {

/// Of each row of all records, one after the other: how far its plateau's speed had to go, rad/s, while the
/// speed has not settled; 0 afterwards. `noise` is the scatter of settled rows, rad/s.
struct MovingRows {
  std::vector<double> step;
  double noise = 0.0;
};
MovingRows moving_rows(const std::vector<StepRecord>& records);

struct TransientMisfit {
  double sigma = 0.0;  ///< rad/s, of settled rows
  double share =
      0.0;  ///< of the step; 0 where moving rows are no further off than settled ones, beyond chance
};

/// From the residuals of a fit, rad/s, by medians.
TransientMisfit transient_misfit(std::span<const double> residuals, const MovingRows& rows);

/// Rows that stand out of their neighbours on both sides, beyond noise: no answer of a motor.
std::vector<bool> lone_spikes(const std::vector<StepRecord>& records, double noise);

}  // namespace ident
