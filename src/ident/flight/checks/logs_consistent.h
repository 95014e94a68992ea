// Do the logs of one campaign agree on the constants that they share?
#pragma once

#include <span>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Warns (`logs_disagree`) of a log without which several constants would be another vehicle's: that is what
/// one Newton step without its blocks of time says. Names the log with which the constants as stated fit
/// least.
std::vector<Warning> logs_agree(const FlightRecord& record, std::span<const FlightLog> logs,
                                const Theta& theta, const FlightFit& fit);

}  // namespace ident
