// The diagnosis of logs without rates and attitude: whether the balance of the rotors is that of the model,
// and which cause that shows in it explains the difference.
#pragma once

#include "ident/flight/record/flight_record.h"
#include "ident/gap/diagnose.h"

namespace ident {

/// Fills `out` as a diagnosis does; nothing is predicted over half a second, so its `gap` stays empty. `p`:
/// constants as stated.
void diagnose_trim(Diagnosis& out, const FlightRecord& record, const std::vector<double>& p,
                   const std::vector<std::string>& exclude);

}  // namespace ident
