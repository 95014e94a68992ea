// Steps over the shared unknowns of a flight fit: Ceres' trust region from afar, Newton's near the minimum.
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
const ReducedSystem& linearize_at(FlightSmoother& smoother, const Eigen::VectorXd& u);

/// Whether the model could be flown there.
bool is_finite(const ReducedSystem& system);

/// Samples that the cost is a sum over: about one each near the minimum.
double samples_of(const FlightRecord& record);

/// To the minimum of the quadratic form of the smoother's last linearisation, priors included.
struct NewtonStep {
  Eigen::VectorXd du;
  double fall = 0.0;  ///< of the cost
};
NewtonStep newton_step(const FlightSmoother& smoother, const Eigen::VectorXd& u);

/// Whether a step from u may be taken unseen, as far as its length goes: it leads to constants that are
/// possible and changes none that is positive by more than a factor of e.
bool is_short(const Theta& theta, const Eigen::VectorXd& u, const Eigen::VectorXd& du);

/// A step that promises less than this fall of the cost is near the minimum.
inline constexpr double kNear = 25.0;

/// When Ceres' trust region ends, and how it begins.
struct TrustRegion {
  double tolerance = 1e-3;  ///< fall of the cost that is not worth a step
  double near = 0.0;        ///< a whole step promises less than this: near the minimum
  int max_steps = 30;
  /// Of a first radius: it would hold a step back along directions that only priors determine, which are weak
  /// beside those that the flight does.
  bool free = true;
};
/// Raises DataError where the model cannot be flown at `start`.
SharedMinimum by_trust_region(FlightSmoother& smoother, const Eigen::VectorXd& start,
                              const TrustRegion& region);

/// The shared unknowns alone, states and noise as they are, from `start` to where no more than `enough` of a
/// fall of the cost is promised: a trust region from afar, Newton's steps near the minimum. The smoother is
/// linearised and accepted there.
SharedMinimum minimise_shared(FlightSmoother& smoother, const Eigen::VectorXd& start, double enough,
                              int most_steps = 0);

/// Information of the priors; weak where there is none, which keeps undetermined directions in place.
Eigen::MatrixXd prior_information(const Theta& theta, const Eigen::VectorXd& u);

/// Inverse of a symmetric positive definite matrix whose unknowns have very unlike scales.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& M);

/// Inverse of information + prior, which is positive definite, and that information without what is rounding:
/// where a log has next to no noise, a direction that it does not tell would seem to be told by the last
/// digits of the others.
struct Posterior {
  Eigen::MatrixXd covariance, information;
};
Posterior posterior(const Eigen::MatrixXd& information, const Eigen::MatrixXd& prior);

}  // namespace ident
