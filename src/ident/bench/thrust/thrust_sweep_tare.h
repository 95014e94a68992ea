// The tare of a log: readings at rest before, between and after the steps, and its drift from one to the
// next.
#pragma once

#include <span>
#include <vector>

namespace ident {

/// One stay at rest: its level, and how well the level is known (colour of the readings included).
struct RestStay {
  double place = 0.0, value = 0.0, std = 0.0;
};
RestStay rest_stay(double place, std::span<const double> readings);

/// Tare over time. Stays that differ by more than their own errors show a drift, taken as linear from one to
/// the next; what a drift does in between is known to 1/sqrt(12) of its size (the mean of a Brownian bridge).
class TareDrift {
 public:
  explicit TareDrift(std::vector<RestStay> stays);

  double mean() const { return mean_; }
  double std() const { return std_; }
  bool drifts() const { return drifts_; }
  /// Tare at a place less the mean; 0 where there is no drift.
  double deviation(double place) const;

 private:
  std::vector<RestStay> stays_;
  double mean_ = 0.0, std_ = 0.0;
  bool drifts_ = false;
};

}  // namespace ident
