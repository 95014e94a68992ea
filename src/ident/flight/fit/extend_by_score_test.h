// Frees constants that a vehicle file does not state where the flight contradicts their default: a command
// offset (brushed motors and many speed controllers have one), a dead time, the inertia of the rotors.
#pragma once

#include <functional>
#include <memory>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// A fit and what it refers to.
struct FittedFlight {
  std::unique_ptr<Theta> theta;
  FlightFit fit;
};

struct WatchOptions {
  std::vector<std::string> watched;  ///< of Omega_0, dead_time, Jp: held where nobody states them
  std::vector<std::string> also;     ///< constants that are free besides those of the vehicle
  std::function<void(double)> progress;
};

/// Exact fit of the constants. A watched constant is freed where the logs contradict it, and Omega_0 also
/// where thrust does not carry the weight and an offset mends that; `result` is warned. A freed constant that
/// turns out to be nothing is held again in the end.
FittedFlight fit_and_watch(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
                           std::vector<FreeConstant> constants, const WatchOptions& options, Result& result);

}  // namespace ident
