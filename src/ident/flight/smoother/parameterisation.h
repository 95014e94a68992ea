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

/// One free constant. Positive ones move as value = start exp(u), others as value = start + scale u.
struct FreeConstant {
  std::string name;
  int index = 0;  ///< place in the model's parameter vector
  bool positive = false;
  double start = 0.0, scale = 1.0;
  std::optional<double> prior_std;  ///< about `prior_value`
  double prior_value = 0.0;
  /// Model indices of others that are known together with it, and the correlation of the two priors. What is
  /// positive is normal in its logarithm then: a product that is known makes a straight line there.
  std::vector<std::pair<int, double>> known_with;
  bool adopted = false;  ///< belongs to a cause that a diagnosis took up, not to the model as stated
  bool watched = false;  ///< held where it is; only what the flight says against that is looked at
  /// Slot of another free constant: what moves on its own is the product with that (a payload's moment, not
  /// its place), value = (start + scale u) start_other / other.
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
  /// Standard deviation of that value, from the covariance of u.
  double deviation(const Eigen::VectorXd& u, int i, const Eigen::MatrixXd& covariance) const;

  /// The model's constants at u, and the gyro bias of a log.
  std::vector<double> p(const Eigen::VectorXd& u) const;
  std::array<double, 3> gyro_bias(const Eigen::VectorXd& u, int log) const;
  std::vector<Seed> seeds(const Eigen::VectorXd& u, int log) const;
  PriorTerms prior(const Eigen::VectorXd& u) const;
  /// The inertia at u, products and effects included, kg m^2.
  Eigen::Matrix3d inertia(const Eigen::VectorXd& u) const;
  /// Whether that is positive definite. With the moments in
  /// logarithms it always is as long as there are no products.
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

/// The constants of a vehicle that a refinement frees: those with a standard deviation or without a value
/// that the model needs, as far as `signals` can involve them. `also` names further ones.
std::vector<FreeConstant> free_constants(const Vehicle& vehicle, const std::vector<double>& p,
                                         const std::vector<std::string>& also = {});

/// Distance from its null value beyond which an effect's constant is not physical on this vehicle; infinite
/// for any other.
double physical_limit(const FreeConstant& constant);

/// Parts one constant (its model index) from those that it is known together with: what is known of them
/// stays, whatever becomes of it. For one that is held or freed of what was stated of it.
void know_alone(std::vector<FreeConstant>& constants, int index);

/// Takes out the constants from command to rotor speed, of which logs without commands say nothing.
void leave_out_motors(std::vector<FreeConstant>& constants);

}  // namespace ident
