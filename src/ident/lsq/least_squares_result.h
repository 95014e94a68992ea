// What a caller asks a finished fit: intervals of unknowns and of functions of them.
#pragma once

#include "ident/lsq/least_squares.h"

namespace ident {

/// An unknown as parameter of a result: interval by its t quantile (in the logarithm for positive ones),
/// naive standard deviation, and `identifiable` (standard deviation below 10 % of the value).
Parameter fitted_parameter(const LeastSquaresFit& fit, const std::string& name, std::string unit,
                           std::string source);

/// The same for a function of the unknowns with that value and gradient.
Parameter derived_parameter(const LeastSquaresFit& fit, std::string name, double value,
                            const Eigen::VectorXd& gradient, std::string unit, std::string source);

/// Correlation of some unknowns, within what the data determine of them.
Correlation fitted_correlation(const LeastSquaresFit& fit, std::vector<std::string> names);

/// r = A x - y for problems that are linear.
ResidualFunction linear_residuals(Eigen::MatrixXd A, Eigen::VectorXd y);

}  // namespace ident
