// Steps over the shared unknowns of a flight fit: Ceres' trust region far from the minimum, Newton steps near
// it.
#pragma once

#include <Eigen/Core>

#include "ident/flight/smoother/smoother.h"

namespace ident {

/// Where steps over the shared unknowns ended.
struct SharedMinimum {
  Eigen::VectorXd u;
  double cost = 0.0;  ///< priors included
  int steps = 0;
};

/// Linearises at u; where the last linearisation is there already, only the process noise can have changed.
const ReducedSystem& linearize_at(FlightSmoother& smoother, const Eigen::VectorXd& u, bool leverage = false);

/// Whether the simulation stayed finite there.
bool is_finite(const ReducedSystem& system);

/// Number of samples in the cost, which is about one each near the minimum.
double samples_of(const FlightRecord& record);

/// Step to the minimum of the quadratic form of the last linearisation, priors included.
struct NewtonStep {
  Eigen::VectorXd du;
  double fall = 0.0;  ///< of the cost
};
NewtonStep newton_step(const FlightSmoother& smoother, const Eigen::VectorXd& u);

/// Whether a step from u is short enough to be taken without an evaluation: the constants stay possible, and
/// no positive one changes by more than a factor of e.
bool is_short(const Theta& theta, const Eigen::VectorXd& u, const Eigen::VectorXd& du);

/// A step that promises a smaller decrease of the cost than this is near the minimum.
inline constexpr double kNear = 25.0;

/// When Ceres' trust region ends, and how it begins.
struct TrustRegion {
  double tolerance = 1e-3;  ///< decrease of the cost that is not worth a step
  double near = 0.0;        ///< a whole step promises less than this: near the minimum
  int max_steps = 30;
  /// Without a first radius, which would hold a step back along directions that only priors determine.
  bool free = true;
  bool leverage = false;  ///< linearise with leverages, for a round of noise where it ends
};
/// Throws DataError where the simulation diverges at `start`.
SharedMinimum by_trust_region(FlightSmoother& smoother, const Eigen::VectorXd& start,
                              const TrustRegion& region);

/// Minimises over the shared unknowns, noise as it is, until a step promises a decrease of at most `enough`.
/// The smoother is linearised and accepted there.
SharedMinimum minimise_shared(FlightSmoother& smoother, const Eigen::VectorXd& start, double enough,
                              int most_steps = 0);

/// Information of the priors; weak where there is none, which keeps undetermined directions in place.
Eigen::MatrixXd prior_information(const Theta& theta, const Eigen::VectorXd& u);

/// Inverse of a symmetric positive definite matrix whose unknowns have very unlike scales.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& M);

/// Inverse of information + prior, which is positive definite, and the information without rounding errors:
/// with next to no noise the last digits of well determined directions would look like information on the
/// others.
struct Posterior {
  Eigen::MatrixXd covariance, information;
};
Posterior posterior(const Eigen::MatrixXd& information, const Eigen::MatrixXd& prior);

}  // namespace ident
