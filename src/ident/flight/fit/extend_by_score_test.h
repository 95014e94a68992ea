// Constants that a vehicle file need not state, and that a flight may contradict: whether rotor speed is
// proportional to the command (brushed motors and many speed controllers have an offset), and follows it
// without a dead time; whether rotors have inertia.
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

/// An exact fit of the constants; of watched ones too where the logs contradict them, and of Omega_0 where
/// thrust does not carry the weight and an offset puts that right: `result` is warned then. What turns out to
/// be nothing by chance, once all is found, is held again.
FittedFlight fit_and_watch(const Vehicle& vehicle, const std::vector<double>& p, const FlightRecord& record,
                           std::vector<FreeConstant> constants, const WatchOptions& options, Result& result);

}  // namespace ident
