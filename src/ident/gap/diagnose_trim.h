// The diagnosis of logs without rates and attitude: whether the balance of the rotors is that of the model,
// and which cause that shows in it explains the difference.
#pragma once

#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

/// Fills `result` as a diagnosis does; nothing is predicted over half a second, so `gap` holds nulls. Gives
/// the vehicle with the cause found. `p`: constants as stated.
Vehicle diagnose_trim(Result& result, const FlightRecord& record, const std::vector<double>& p,
                      const std::vector<std::string>& exclude);

}  // namespace ident
