// A fit on its way, from its first steps to its end.
#pragma once

#include <functional>
#include <memory>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_steps.h"

namespace ident {

/// One fit on its way: shared unknowns, noise and chunks over a record or an excerpt of it.
class Fitting {
 public:
  Fitting(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options);

  /// From what was measured and stated.
  void begin();

  /// The same, after rounds of noise at what was stated.
  void begin_with_noise();

  /// Whether it is not near a minimum, or misses more than noise.
  bool misses();

  /// The farthest that a constant is from what was stated, in deviations.
  double pull() const;

  /// Of its noise and unknowns: the less the likelier.
  double surprise();

  /// From where the fit of an excerpt ended; false where that is far from anything here.
  bool go_on_from(const Fitting& excerpt);

  /// Noise and unknowns in turn. Chunks may change in the first two rounds.
  void find_noise(const std::function<void(double)>& tell);

  /// Whether there is so little noise that it shows how flight is simulated, in `times` as much flight; by
  /// finer steps from then on.
  bool steps_show(double times = 1.0);

  /// To the minimum, under the noise found.
  FlightFit finish();

 private:
  /// Whether some of the states have nothing to do with what was measured.
  bool is_lost() const;
  TrustRegion first_steps() const;
  bool gave_up() const { return options_.most_steps > 0 && steps_ >= options_.most_steps; }
  FlightFit unfinished() const;
  // To where the first step begins: states as measured, in chunks short enough for what they miss.
  void set_out();
  void start(const NoiseModel& noise);
  // From the states that were measured, or those of `from`.
  void restart(const NoiseModel& noise, int rounds = 2, const FlightSmoother* from = nullptr);
  // What there is of a like model, over the same record.
  const FlightSmoother* near() const;
  bool steps_far(const NewtonStep& step);
  void trust_region(const TrustRegion& region);

  const FlightRecord& record_;
  const Theta& theta_;
  const FlightFitOptions& options_;
  Eigen::VectorXd u_;
  std::shared_ptr<FlightSmoother> smoother_;
  Steps by_;  // which flight is simulated
  Steps serves_ = Steps::fine;
  double chunk_ = 0.0;
  int steps_ = 0;
  bool gone_on_ = false;                           // from an excerpt, which knew the noise
  bool axes_asked_ = false, axes_chosen_ = false;  // here; beyond doubt
};

}  // namespace ident
