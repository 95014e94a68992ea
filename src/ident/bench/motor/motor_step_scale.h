// How far from the motor's equation rows in a transient are, against rows at rest on a plateau.
//
// No motor obeys its equation to the noise of a good speed sensor. With noise of the plateaus alone as scale,
// whole transients would be outliers. The scale of a row is therefore
//
//     sigma_i^2 = sigma^2 + (share D_i)^2 ,   D_i = sqrt(d_i step)                                        (1)
//
// with d_i what the speed still has to go to the level of its plateau, beyond noise, and `step` the most that
// it had to go there. In D = d the last rows of an answer would count as much as all before; in D = step they
// would have to be exact.
#pragma once

#include <span>
#include <vector>

#include "ident/bench/motor/motor_step_record.h"

namespace ident {

/// D of (1) for the rows of all records, one after the other.
std::vector<double> ways_to_go(const std::vector<StepRecord>& records);

struct TransientError {
  double sigma = 0.0;  ///< rad/s, of settled rows
  double share = 0.0;  ///< 0 where transients are no further off than settled rows, beyond chance
};

/// From the residuals of a fit, rad/s, by medians.
TransientError transient_error(std::span<const double> residuals, std::span<const double> ways);

/// sigma_i/sigma of (1) for each row.
std::vector<double> row_scales(const TransientError& error, std::span<const double> ways);

}  // namespace ident
