// Verification as in [Phang] section 5: short open-loop simulations against the log, channel by channel.
#pragma once

#include "ident/flight/refine.h"

namespace ident {

/// `ident flightlog`: the vehicle as stated against the logs over short windows, as [Phang] verifies his
/// model: RMS, fit in percent and Theil's inequality coefficient per channel.
Result verify_flight(const Vehicle& vehicle, std::span<const FlightLog> logs, double horizon = 1.0);

}  // namespace ident
