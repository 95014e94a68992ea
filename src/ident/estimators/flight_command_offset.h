// Whether rotor speed is proportional to the command: brushed motors and many speed controllers have an
// offset.
#pragma once

#include <functional>
#include <memory>

#include "ident/core/result.h"
#include "ident/estimators/flight_fit.h"

namespace ident {

/// Adds Omega_0 to the constants of a fit, held at zero and watched: what the flight says against that comes
/// with the fit. Not where the vehicle states Omega_0 or it is free.
void watch_command_offset(std::vector<FreeConstant>& constants, const Vehicle& vehicle,
                          const FlightRecord& record, const std::vector<double>& p);

/// Whether the logs contradict a speed proportional to the command beyond any doubt: one Newton step from the
/// fit with the watched Omega_0 free, against its spread over blocks of time.
bool shows_command_offset(const Theta& theta, const FlightFit& fit);

/// A fit and what it refers to.
struct FittedFlight {
  std::unique_ptr<Theta> theta;
  FlightFit fit;
};

struct OffsetOptions {
  bool ask = true;                ///< whether there may be an offset at all
  std::vector<std::string> also;  ///< constants that are free besides those of the vehicle
  std::function<void(double)> progress;
};

/// An exact fit of the constants; of Omega_0 too where the logs contradict a speed proportional to the
/// command, or where thrust does not carry the weight and an offset puts that right: `result` is warned then.
FittedFlight fit_with_offset_if_asked(const Vehicle& vehicle, const std::vector<double>& p,
                                      const FlightRecord& record, std::vector<FreeConstant> constants,
                                      const OffsetOptions& options, Result& result);

}  // namespace ident
