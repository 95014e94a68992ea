// The diagnosis from forces and moments along measured motion: where no model of a whole flight follows it,
// this one still says what acts on the vehicle.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/flight/prepare.h"
#include "ident/gap/diagnose.h"
#include "ident/gap/found_by_ladder.h"

namespace ident {

/// A diagnosis of that kind; and by the first part of the flight the constants of its model, and of the one
/// without causes.
struct WindowDiagnosis : Diagnosis {
  std::vector<double> trained, without_causes;
  std::vector<std::string> of_forces;  ///< names of causes that forces show
};

/// Of a flight that was entered, with what `begun` says of it, beside what the ladder found. None where
/// neither forces nor moments were logged along with how the vehicle turned.
std::optional<WindowDiagnosis> diagnose_windows(const Vehicle& vehicle, std::span<const FlightLog> logs,
                                                const GapOptions& options, const FlightEntry& entry,
                                                const Result& begun,
                                                const std::optional<FoundByLadder>& found_before);

}  // namespace ident
