// A vehicle file drafted from what a log says of the vehicle.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/data/log_streams.h"

namespace ident {

struct VehicleDraft {
  std::string yaml;                  ///< with comments: where each line comes from, FILL IN, ASSUMED
  std::vector<std::string> fill_in;  ///< what the log cannot know: mass
  std::vector<std::string> notices;  ///< where logs of one vehicle differ
};

/// Drafts the vehicle of the first log; others are compared with it. Throws DataError where no log states the
/// place of a rotor.
VehicleDraft draft_vehicle(std::span<const LogStreams> logs);

}  // namespace ident
