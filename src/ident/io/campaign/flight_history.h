// What a campaign's parameter file was before flights were refined, so that a flight is evidence once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

struct FlightHistory {
  Vehicle before, after;           ///< the parameter file: as it was, and as the refinement wrote it
  std::vector<InputFile> logs;     ///< that were refined
  std::vector<InputFile> earlier;  ///< that `before` rests on already

  /// Whether the parameter file `now` still holds something that the refinement found.
  bool is_in(const Vehicle& now) const;
  /// The parameter file `now` without what the refinement made of it: what was changed since is kept, and
  /// what was taken out stays out.
  Vehicle undone(const Vehicle& now) const;
};

/// Place of the history in a campaign's folder.
std::string flight_history_path(const std::string& folder = ".");

/// Nothing where no refinement was stored. Throws InputError where it cannot be read.
std::optional<FlightHistory> read_flight_history(const std::string& folder = ".");

std::string flight_history_text(const FlightHistory& history);

}  // namespace ident
