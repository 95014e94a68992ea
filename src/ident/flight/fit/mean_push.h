// The mean vertical acceleration from outside over a flight. Gusts have none: it is thrust that is not as
// fitted.
#pragma once

#include <cmath>
#include <optional>

#include "ident/flight/fit/fit.h"

namespace ident {

/// Mean acceleration from outside along the vertical (down), m/s^2, and how far gusts as strong as those that
/// were found may take it.
struct SteadyPush {
  double mean = 0.0, std = 0.0;
  double seconds = 0.0;
  std::optional<int> log;  ///< of this one; over all logs without

  /// Whether thrust is off by more than a twentieth of the weight, beyond chance.
  bool matters(double gravity) const { return std::abs(mean) > limit(gravity); }
  double limit(double gravity) const;
};

/// Over all logs, or in that one where it stands out most if that is more: a full battery and an empty one
/// make no good mean.
SteadyPush steady_push(const FlightRecord& record, const FlightFit& fit);

}  // namespace ident
