// How a body turned, summed up along its own axes: what gyros and attitudes have in common.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// The running sum of small rotations about the axes of the body, rad, at the instants that were sampled.
struct RunningTurn {
  std::vector<double> t;  ///< s
  std::vector<Eigen::Vector3d> turn;

  double interval() const;  ///< s, usual between samples; 0 without two of them
};
RunningTurn turn_of_attitudes(const FlightLog& log);
/// The integral of the rates.
RunningTurn turn_of_gyro(const FlightLog& log);

/// Reads off mean rates over windows of `width` s, rad/s, for times that rise from call to call.
class MeanRate {
 public:
  MeanRate(const RunningTurn& turn, double width) : turn_(turn), width_(width) {}

  /// NaN where the window is not covered, or spans a gap in the samples of twice its width.
  Eigen::Vector3d at(double t);

 private:
  Eigen::Vector3d turned_at(double t, std::size_t& row) const;

  const RunningTurn& turn_;
  double width_;
  std::size_t early_ = 0, late_ = 0;  ///< rows before the ends of the last window
};

}  // namespace ident
