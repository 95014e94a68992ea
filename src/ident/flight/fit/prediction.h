// Prediction error on held-out flight, from states that were estimated from the past only.
#pragma once

#include <vector>

#include "ident/flight/fit/fit.h"

namespace ident {

/// One window: per channel the sum of (error/sigma)^2, the same for a perfect model, and the number of
/// samples.
struct PredictionWindow {
  int log = 0;
  double t = 0.0;  ///< start, s
  std::array<double, kChannels> square{}, floor{}, count{};
  /// Mean over measured channels.
  double error2() const;
  double floor2() const;
};

struct PredictionOptions {
  std::vector<double> horizons{0.1, 0.5, 1.0};  ///< s
  double history = 0.8;  ///< s of data from which the state at the window's start is estimated
  double spacing = 1.0;  ///< s between window starts
  bool floors = true;    ///< false: the floor is NaN, at a third of the cost
  Steps steps = Steps::fine;
  int threads = 0;
};

/// Predicts windows of the record with the constants `theta` at `u`. The process noise of `noise` counts in
/// the floor, because no model predicts gusts. One list for each horizon.
std::vector<std::vector<PredictionWindow>> predict_windows(const FlightRecord& record, const Theta& theta,
                                                           const Eigen::VectorXd& u, const NoiseModel& noise,
                                                           const PredictionOptions& options);

/// Root of the mean of error2 and floor2 over windows, and a 95 % interval of the first by bootstrap over
/// windows.
struct PredictionSummary {
  double error = kNaN, floor = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
  std::size_t windows = 0;
};
PredictionSummary summarise(const std::vector<PredictionWindow>& windows);

/// 1 - (after^2 - floor^2)/(before^2 - floor^2), at most 1, with a bootstrap interval; NaN where before is
/// not above the floor.
struct GapClosed {
  double closed = kNaN;
  std::array<double, 2> ci95{kNaN, kNaN};
  double before = kNaN, after = kNaN, floor = kNaN;
  bool held_out = true;  ///< there was held-out flight, whether or not it could be predicted
};
GapClosed gap_closed(const std::vector<PredictionWindow>& before, const std::vector<PredictionWindow>& after);

}  // namespace ident
