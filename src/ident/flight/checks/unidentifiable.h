// What a fit contradicts of what was known, and what it does not determine.
#pragma once

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Warns where the flight disagrees with what was known beforehand, and of what it does not determine.
void warn_about(Result& result, const Theta& theta, const FlightFit& fit);

}  // namespace ident
