// The file of a vehicle, a simulator's or YAML, with the values that were identified.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/io/simulators/changes.h"

namespace ident {

struct FixedFile {
  std::string text;
  std::string format;               ///< the simulator's target; "vehicle" for YAML
  std::vector<FileChange> changes;  ///< in the file's own names
  std::vector<std::string> lost;    ///< what the file cannot hold
  std::vector<std::string> notes;   ///< entries that could not be placed, and what is not kept
};

/// The vehicle file at `path`, which states `stated`, with the values of `identified`. Of a simulator's file
/// nothing but the values that differ changes; they make up for what it cannot hold, along the flight of
/// these logs (refit.h). YAML is written anew. Throws InputError.
FixedFile fixed_file(const std::string& path, const Vehicle& stated, const Vehicle& identified,
                     std::span<const FlightLog> logs);

}  // namespace ident
