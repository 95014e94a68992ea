// Windows of an inertial sensor's samples, and the tones that turning rotors would leave in them.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Samples of one sensor over a short time, in units of its noise.
struct ToneWindow {
  std::size_t arc = 0;
  std::vector<std::size_t> rows;
  std::shared_ptr<const Eigen::MatrixXd>
      cosines;  ///< orthonormal, all that samples can show, slow ones first
  Eigen::MatrixXd
      taken;             ///< [cosine][axis] share of its variance in this log that is more than noise: motion
  Eigen::MatrixXd y;     ///< [sample][axis]; 0 of an axis that was never sampled
  Eigen::MatrixXd told;  ///< the same, weighted()

  /// Columns over the samples, multiplied by the inverse of the covariance of motion and noise.
  Eigen::MatrixXd weighted(const Eigen::MatrixXd& x, Eigen::Index axis) const {
    return x - *cosines * (taken.col(axis).asDiagonal() * (cosines->transpose() * x));
  }
};

/// Windows of a sensor, each of so many seconds, and the noise of its axes.
struct ToneWindows {
  std::vector<ToneWindow> windows;
  double seconds = 0.0;
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();
};

/// Windows of the three axes from channel `group` on, one after the other from `begin` of their length after
/// the start of each arc, of `seconds` or of so many samples as tell something, whichever is longer; `sigma`
/// as another such call found it.
ToneWindows tone_windows(const FlightRecord& record, int group, double seconds, double begin = 0.0,
                         const Eigen::Vector3d* sigma = nullptr);

/// Where what happens so often shows when it is sampled so often, Hz.
double folded(double hz, double sampled);

/// Whether the spectrum of a channel has anything above that of motion that stands out of its own median. For
/// a first look: a filter's slope does as well.
bool has_uneven_spectrum(const FlightRecord& record, int channel);

/// Turns of the rotors at the rows of a record; refers to it.
class TurningRotors {
 public:
  /// By speeds as measured, or as simulated from the commands where not all were.
  explicit TurningRotors(const FlightRecord& record);

  int count() const { return count_; }
  bool measured() const { return measured_; }
  double usual() const { return usual_; }  ///< speed, rad/s

  /// exp(i angle) since the first sample of a window: [sample][rotor]; `scale` corrects the speeds.
  Eigen::ArrayXXcd turned(const ToneWindow& window, double scale) const;
  /// Square of each rotor's speed in a window over the usual one, as which amplitudes grow; 0 of one that
  /// idles.
  Eigen::VectorXd sizes(const ToneWindow& window) const;
  /// Hz at which `order` times the turns of each rotor show in the samples of a window, folded by their rate.
  Eigen::VectorXd folded(const ToneWindow& window, int order, double scale) const;

 private:
  const FlightRecord* record_;
  std::vector<std::vector<std::vector<double>>> speed_, angle_;  // [arc][rotor][row]
  double usual_ = 0.0;                                           // rad/s
  int count_ = 0;
  bool measured_ = false;
};

}  // namespace ident
