// Windows of flight to be predicted, each from a state that was estimated from the past only.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "ident/flight/smoother/smoother.h"

namespace ident {

struct WindowOptions {
  double history = 0.8;   ///< s of data from which the state at the window's start is estimated
  double spacing = 1.0;   ///< s between window starts
  double shortest = 0.1;  ///< s that must be left of the arc
  Steps steps = Steps::fine;
  int threads = 0;
};

struct FlightWindow {
  std::size_t arc = 0, first = 0, row = 0;  ///< history from `first`, window from `row`
};

/// The windows of a record under constants `theta` at `u`; record and theta must outlive it.
class FlightWindows {
 public:
  FlightWindows(const FlightRecord& record, const Theta& theta, const Eigen::VectorXd& u,
                const NoiseModel& noise, const WindowOptions& options);

  std::size_t size() const { return windows_.size(); }
  const FlightWindow& operator[](std::size_t w) const { return windows_[w]; }
  /// Covariance of the state at the start.
  const Eigen::MatrixXd& covariance(std::size_t w) const { return ends_[w].P; }
  /// The rows of a window of `horizon` seconds, ready to be evaluated. `end` is at the last row of the arc or
  /// beyond where the arc does not hold the window. Gusts are left out: no model predicts them.
  ChunkTask task(std::size_t w, double horizon) const;
  void in_parallel(const std::function<void(std::size_t)>& work) const;

 private:
  const FlightRecord* record_;
  const Theta* theta_;
  Eigen::VectorXd u_;
  Steps steps_;
  std::vector<double> p_;
  std::array<double, kChannels> weight_{};
  std::vector<FlightWindow> windows_;
  FlightRecord past_;
  std::unique_ptr<Theta> fixed_;
  std::unique_ptr<FlightSmoother> smoother_;
  std::vector<FlightSmoother::End> ends_;
};

}  // namespace ident
