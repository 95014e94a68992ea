// How strong the tones of rotors are in a sensor, by the data alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ident/flight/conditioning/rotor_tones.h"

namespace ident {

/// Gaussian amplitudes of the tones of rotors at multiples (`orders`) of their turns, in each window
/// anew, with a variance for each tone and axis that goes with the fourth power of the rotor's speed: that by
/// which the samples are most likely, beside white noise and motion. MacKay's iteration ("Bayesian
/// interpolation", Neural Computation 4, 1992).
class ToneSizes {
 public:
  /// Of the rotors as `turning` has them, `scale` times as fast.
  ToneSizes(const TurningRotors& turning, const ToneWindows& sensor, std::vector<int> orders, double scale);

  /// [order, and in it rotor][axis] variance of cosine and sine at the usual speed, in units of the windows'
  /// noise; what of that is noise, where tones are taken out.
  const Eigen::MatrixXd& variance() const { return found_.variance; }
  const Eigen::Vector3d& noise() const { return found_.noise; }
  /// Over that of no tones, nats.
  double log_likelihood() const { return found_.log_likelihood; }
  /// The same if only that rotor had tones.
  double log_likelihood_of(int rotor) const;
  /// The tones in a window as far as its samples tell: [sample][axis], in units of the noise.
  Eigen::MatrixXd expected(const ToneWindow& window) const;
  /// Variance on an axis of those tones in a window that show below so many Hz, where they pass for motion:
  /// the largest of the axes, in units of the noise.
  double passes_for_motion(const ToneWindow& window, double hz) const;

 private:
  // What a window says of the tones on an axis.
  struct Told {
    Eigen::MatrixXd G;
    Eigen::VectorXd b;
    double square = 0.0, samples = 0.0;
  };
  using ToldWindows = std::vector<std::array<Told, 3>>;
  struct Found {
    Eigen::MatrixXd variance;
    Eigen::Vector3d noise = Eigen::Vector3d::Ones();
    double log_likelihood = 0.0;
  };
  struct Posterior {
    Eigen::VectorXd mean, variance;
    double log_det = 0.0;
  };

  static Told told_by(const ToneWindow& window, const Eigen::MatrixXd& tones, Eigen::Index axis);
  static Posterior posterior(const Told& told, const Found& by, Eigen::Index axis);
  static Found updated(const ToldWindows& windows, const Found& from, const Eigen::MatrixXd& most);
  Found found_from(const ToldWindows& windows) const;
  Eigen::MatrixXd tones_in(const ToneWindow& window) const;

  const TurningRotors& turning_;
  std::vector<int> orders_;
  double scale_;
  ToldWindows windows_;
  Found found_;
};

}  // namespace ident
