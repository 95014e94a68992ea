// The balance of all stretches fitted, under their noise and what rotors scatter by from flight to flight.
#pragma once

#include "ident/flight/trim/trim.h"

namespace ident {

/// Under the noise and scatter of `like` if that is given, else under what the flights themselves show.
/// `hold_common`: what all rotors gain alike is the thrust constant's.
TrimFit fit_trim(const FlightRecord& record, const Trim& trim, const Theta& theta, bool hold_common,
                 const TrimFit* like = nullptr);

}  // namespace ident
