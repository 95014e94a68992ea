// The door to nonlinear least squares: robust, with level and colour of the noise estimated from the data.
//
//     y_i = f_i(x) + noise ,   r_i(x) = f_i(x) - y_i
//
// Give residuals in the unit of the measurement, not weighted: the noise level of each group of residuals is
// estimated (restricted maximum likelihood), autocorrelation within a series likewise (autoregressive, order
// by information criterion), outliers are found and left out. The covariance accounts for all of it, and
// `t` intervals for the few degrees of freedom with which the noise itself is known.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// Fills r(x) and, when J is not null, dr/dx. Both have their size already; J starts at zero.
/// False: x is impossible (a step there is taken back).
using ResidualFunction =
    std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J)>;

/// Positive ones are estimated as their logarithm; x and J above are in physical values all the same.
enum class Coordinate { real, positive };

struct Unknown {
  std::string name;
  double start = 0.0;
  Coordinate coordinate = Coordinate::real;
};

/// Residuals that share level and colour of the noise: one sensor, say.
struct NoiseGroup {
  std::string name;
  std::optional<double> known_sigma = {};  ///< standard deviation, when it is known (a prior, say)
  bool in_time_order = true;               ///< look for autocorrelation
  bool may_have_outliers = true;           ///< false for priors
};

/// Consecutive residuals [begin, end) from one sensor in one recording, in time order.
struct ResidualSeries {
  Eigen::Index begin = 0, end = 0;
  int group = 0;                  ///< index into the noise groups
  bool may_have_outliers = true;  ///< false where too few rows would tell which of them is the odd one
};

struct LeastSquaresProblem {
  std::vector<Unknown> unknowns;
  Eigen::Index residuals = 0;
  ResidualFunction evaluate;
  std::vector<NoiseGroup> groups;            ///< empty: one
  std::vector<ResidualSeries> series;        ///< empty: one, all residuals
  std::vector<Eigen::VectorXd> more_starts;  ///< physical values, besides Unknown::start
  /// Residuals that are left out until noise is known, then judged as all others; empty: none.
  std::vector<bool> suspects = {};
};

struct LeastSquaresOptions {
  bool robust = true;
  int max_colour_order = 5;      ///< of the autoregressive noise; 0: white
  bool search_widely = true;     ///< from three trust regions; not needed where starts come from a grid
  double rank_tolerance = 1e-9;  ///< relative, for a Jacobian with columns scaled to length 1
};

/// What was found out about the noise of one group.
struct NoiseEstimate {
  std::string name;
  double sigma = 0.0;      ///< standard deviation of one residual
  double rho = 0.0;        ///< autocorrelation at lag one
  std::vector<double> ar;  ///< r_i = sum ar_k r_(i-k) + innovation
  Eigen::Index used = 0, rejected = 0;
};

/// One set of level and colour of the noise that the data allow: what the solution would be with it.
struct NoiseDraw {
  double weight = 0.0;
  Eigen::VectorXd shift;       ///< of the solution, in the coordinates of determined directions
  Eigen::MatrixXd covariance;  ///< likewise
};

struct LeastSquaresFit {
  std::vector<std::string> names;
  Eigen::VectorXd x;
  std::vector<Coordinate> coordinates;
  Eigen::MatrixXd covariance;  ///< of x; variance infinite for what is not determined, rest of its row 0
  Eigen::MatrixXd naive_covariance;  ///< as if the residuals were independent and of equal size
  int rank = 0;
  /// One column per direction that the data do not determine: components relative to the value for positive
  /// unknowns (d log x), absolute for the others; scaled so that the largest is 1.
  Eigen::MatrixXd undetermined;
  Eigen::VectorXd residuals;              ///< all, outliers included
  Eigen::VectorXd standardized;           ///< decorrelated and divided by their noise; NaN for outliers
  Eigen::VectorXd residual_sigma;         ///< noise level of each residual
  std::vector<bool> rejected;             ///< outliers
  std::vector<NoiseEstimate> noise;       ///< of each group
  double degrees_of_freedom = 0.0;        ///< residuals used minus rank
  double minus_two_log_likelihood = 0.0;  ///< to compare models on the same data
  double bic = 0.0;                       ///< the same plus log(n) for every unknown and noise constant

  /// Place of an unknown; throws std::out_of_range.
  Eigen::Index index(const std::string& name) const;
  double value(const std::string& name) const { return x(index(name)); }
  double std(const std::string& name) const;

  /// Standard deviation of a function of x with that gradient.
  double std_of(const Eigen::VectorXd& gradient) const;
  /// Degrees of freedom with which t95(dof) std is the half width of its interval: white noise by
  /// Satterthwaite, coloured noise by the draws below.
  double dof_of(const Eigen::VectorXd& gradient) const;
  /// Probability of unknowns as far from zero as these when their true values are zero.
  double p_of_zero(const std::vector<Eigen::Index>& unknowns) const;

  // What these work with: directions that the data determine, covariance within them; for white noise its
  // change along each constant of the noise with the covariance of those constants, for coloured noise draws.
  Eigen::MatrixXd directions;
  Eigen::MatrixXd determined_covariance;
  std::vector<Eigen::MatrixXd> covariance_slopes;
  Eigen::MatrixXd noise_constants_covariance;
  std::vector<NoiseDraw> noise_draws;
};

}  // namespace ident
