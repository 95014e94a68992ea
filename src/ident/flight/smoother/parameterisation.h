// The unknowns that all segments share: constants of the model in unconstrained coordinates, and gyro biases
// per log.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ident/flight/kernel/kernel.h"
#include "ident/flight/smoother/prior.h"

namespace ident {

/// One free constant. A positive one is start exp(u), any other start + scale u.
struct FreeConstant {
  std::string name;
  int index = 0;  ///< place in the model's parameter vector
  bool positive = false;
  double start = 0.0, scale = 1.0;
  std::optional<double> prior_std;  ///< about `prior_value`
  double prior_value = 0.0;
  /// Constants (by model index) whose priors are correlated with this one, and the correlation. The priors of
  /// positive constants are then normal in their logarithms, where a known product is a straight line.
  std::vector<std::pair<int, double>> known_with;
  bool adopted = false;  ///< part of a cause that a diagnosis has adopted, not of the model as stated
  bool watched = false;  ///< held at its value; only its score is looked at
  /// Slot of another free constant, whose product with this one is the unknown (the moment of a payload, not
  /// its place): value = (start + scale u) start_other/other. -1: none.
  int times = -1;

  /// Change of the value for a unit step from the start.
  double unit() const { return positive ? start : scale; }
};

class Theta {
 public:
  /// `p`: the model's constants; `logs`: number of logs, each with a gyro bias known to `gyro_bias_std`
  /// (rad/s).
  Theta(std::vector<double> p, std::vector<FreeConstant> constants, int logs, bool gyro,
        double gyro_bias_std = 0.02);

  int size() const { return static_cast<int>(constants_.size()) + (gyro_ ? 3 * logs_ : 0); }
  int constants_count() const { return static_cast<int>(constants_.size()); }
  const std::vector<FreeConstant>& constants() const { return constants_; }
  std::string name(int i) const;

  /// Physical value of unknown i, and its derivative with respect to u_i.
  double physical(const Eigen::VectorXd& u, int i) const;
  double slope(const Eigen::VectorXd& u, int i) const;
  /// Derivatives of all those values (rows) with respect to the unknowns of constants (columns).
  Eigen::MatrixXd slopes(const Eigen::VectorXd& u) const;
  /// Standard deviation of that value, from the covariance of u.
  double deviation(const Eigen::VectorXd& u, int i, const Eigen::MatrixXd& covariance) const;

  /// The model's constants at u, and the gyro bias of a log.
  std::vector<double> p(const Eigen::VectorXd& u) const;
  std::array<double, 3> gyro_bias(const Eigen::VectorXd& u, int log) const;
  std::vector<Seed> seeds(const Eigen::VectorXd& u, int log) const;
  PriorTerms prior(const Eigen::VectorXd& u) const;
  /// The inertia at u, products and effects included, kg m^2.
  Eigen::Matrix3d inertia(const Eigen::VectorXd& u) const;
  /// Whether that inertia is positive definite. Without products of inertia it always is, because the moments
  /// are estimated as logarithms.
  bool possible(const Eigen::VectorXd& u) const;

 private:
  int factor(int i) const;
  double slope_over_factor(const Eigen::VectorXd& u, int i) const;

  std::vector<double> p_;
  std::vector<FreeConstant> constants_;
  int logs_;
  bool gyro_;
  double gyro_bias_std_;
  Eigen::MatrixXd prior_precision_;
  std::vector<bool> prior_in_logarithms_;  ///< of each constant
};

/// The constants that a refinement frees: those that the model always needs, unless the file states them as
/// exact, those with a standard deviation, and those named in `also`.
std::vector<FreeConstant> free_constants(const Vehicle& vehicle, const std::vector<double>& p,
                                         const std::vector<std::string>& also = {});

/// Largest physical distance of the constant of an effect from its null value on this vehicle; infinite for
/// other constants.
double physical_limit(const FreeConstant& constant);

/// Removes the prior correlations of one constant (its model index) with all others; their own priors stay.
/// For a constant that is held, or freed from what was stated of it.
void know_alone(std::vector<FreeConstant>& constants, int index);

/// Removes the constants between command and rotor speed, which logs without commands do not involve.
void leave_out_motors(std::vector<FreeConstant>& constants);

}  // namespace ident
