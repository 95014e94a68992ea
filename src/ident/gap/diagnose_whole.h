// Diagnosis by models of the whole flight, in which the vehicle turns as its model says.
#pragma once

#include <span>
#include <vector>

#include "ident/flight/prepare.h"
#include "ident/gap/diagnose.h"

namespace ident {

struct WholeDiagnosis : Diagnosis {
  std::vector<double> trained;  ///< constants by the first part of the flight
};

/// `begun`: what entering the flight said. Throws DataError where no such model can be fitted.
WholeDiagnosis diagnose_whole(const Vehicle& vehicle, std::span<const FlightLog> logs,
                              const GapOptions& options, const FlightEntry& entry, const Result& begun);

}  // namespace ident
