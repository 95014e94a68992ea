// How strong the tones of rotors are in a sensor, by the data alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ident/estimators/flight_tones.h"

namespace ident {

/// Gaussian amplitudes of the tones of some rotors at multiples (`orders`) of their turns, in each window
/// anew, with a variance for each tone and axis that goes with the fourth power of the rotor's speed: that by
/// which the samples are most likely, beside white noise and motion. MacKay's iteration ("Bayesian
/// interpolation", Neural Computation 4, 1992).
class ToneSizes {
 public:
  ToneSizes(const TurningRotors& turning, const ToneWindows& sensor, std::vector<int> rotors,
            std::vector<int> orders, double scale);

  /// [order, and in it rotor][axis] variance of cosine and sine at the usual speed, in units of the noise.
  const Eigen::MatrixXd& variance() const { return variance_; }
  /// Over that of no tones, nats.
  double log_likelihood() const { return log_likelihood_; }
  /// The tones in a window as far as its samples tell: [sample][axis], in units of the noise.
  Eigen::MatrixXd expected(const ToneWindow& window) const;

 private:
  // What a window says of the tones on an axis; samples less those that motion takes.
  struct Told {
    Eigen::MatrixXd G;
    Eigen::VectorXd b;
    double square = 0.0, left = 0.0;
  };
  struct Posterior {
    Eigen::VectorXd mean, variance;
    double log_det = 0.0;
  };

  static Told told_by(const ToneWindow& window, const Eigen::MatrixXd& tones, Eigen::Index axis);
  Eigen::MatrixXd tones_in(const ToneWindow& window) const;
  Posterior posterior(const Told& told, Eigen::Index axis) const;
  void update(const std::vector<std::array<Told, 3>>& windows, const Eigen::Vector3d& most);

  const TurningRotors& turning_;
  std::vector<int> rotors_, orders_;
  double scale_;
  Eigen::MatrixXd variance_;
  Eigen::Vector3d noise_ = Eigen::Vector3d::Ones();
  double log_likelihood_ = 0.0;
};

}  // namespace ident
