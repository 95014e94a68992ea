// One fit from its first steps to its end.
#pragma once

#include <functional>
#include <memory>

#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fit_steps.h"

namespace ident {

/// The state of a fit: shared unknowns, noise and chunks over a record or an excerpt of it.
class Fitting {
 public:
  Fitting(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options);

  /// Starts from the measurements and the stated constants.
  void begin();

  /// The same, with rounds of noise at the stated constants first.
  void begin_with_noise();

  /// Whether the fit is far from a minimum, or misses more than noise.
  bool misses();

  /// Largest distance of a constant from its prior, in standard deviations.
  double pull() const;

  /// -2 log marginal likelihood of its noise and unknowns.
  double surprise();

  /// Goes on from the end of the fit of an excerpt. False where that is far from anything here.
  bool go_on_from(const Fitting& excerpt);

  /// Estimates noise and unknowns in turn. The length of chunks may change in the first two rounds.
  void find_noise(const std::function<void(double)>& tell);

  /// Whether the present integration steps make a difference in `times` as much flight, because there is so
  /// little noise. Takes finer steps then.
  bool steps_show(double times = 1.0);

  /// Goes to the minimum under the noise found.
  FlightFit finish();

 private:
  /// Whether some states have left what was measured.
  bool is_lost() const;
  TrustRegion first_steps() const;
  bool gave_up() const { return options_.most_steps > 0 && steps_ >= options_.most_steps; }
  FlightFit unfinished() const;
  // Prepares the first step: states as measured, chunks short enough for what they miss.
  void set_out();
  void start(const NoiseModel& noise);
  // Starts anew from the measured states, or from those of `from`.
  void restart(const NoiseModel& noise, int rounds = 2, const FlightSmoother* from = nullptr);
  // The smoother of a similar model over the same record, if there is one.
  const FlightSmoother* near() const;
  bool steps_far(const NewtonStep& step);
  void trust_region(const TrustRegion& region);

  const FlightRecord& record_;
  const Theta& theta_;
  const FlightFitOptions& options_;
  Eigen::VectorXd u_;
  std::shared_ptr<FlightSmoother> smoother_;
  Steps by_;  // integration steps
  Steps serves_ = Steps::fine;
  double chunk_ = 0.0;
  int steps_ = 0;
  bool gone_on_ = false;                           // went on from an excerpt, which knew the noise
  bool axes_asked_ = false, axes_chosen_ = false;  // the question was asked here; the answer is beyond doubt
};

}  // namespace ident
