// One side of a comparison: a vehicle's constants with a given set of causes, fitted to the logs of that
// side.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/gap/hypotheses/candidates.h"

namespace ident {

/// A constant of the fit, and the cause that it belongs to; none: a constant of the vehicle as stated.
struct ComparedName {
  std::string constant, cause;
};

struct ComparedFit {
  std::vector<ComparedName> names;
  Eigen::VectorXd value;       ///< in their own units
  Eigen::MatrixXd covariance;  ///< of `value`, priors included
  /// Change of `value` for a unit change of the truth: the identity where nothing was known before,
  /// 1 - C L with L the information of the priors.
  Eigen::MatrixXd response;
  std::vector<std::string> not_shown;  ///< causes that these logs cannot show
};

/// Fits all causes together, at the rotors that they name (only name and rotor of a candidate count here).
/// Throws DataError where no such model can be flown along these logs.
ComparedFit compared_fit(const Vehicle& vehicle, std::span<const FlightLog> logs,
                         const std::vector<Candidate>& causes);

}  // namespace ident
