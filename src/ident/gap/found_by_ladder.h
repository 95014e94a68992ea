// What forces and moments along measured motion do not tell and the ladder of a refinement does: motors, by
// measured speeds for their commands, and moments that last.
#pragma once

#include <optional>
#include <vector>

#include "ident/flight/ladder/ladder.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

struct FoundByLadder {
  std::vector<Parameter> parameters;
  std::vector<double> trained;          ///< all constants of the model, by the first part of the flight
  double as_stated = kNaN, now = kNaN;  ///< error of speeds after half a second of held-out flight, rad/s
};

/// By the rung of the ladder that was taken. None where it has nothing of the kind.
std::optional<FoundByLadder> found_by_ladder(const LadderResult& ladder);

/// The vehicle, and its model's constants, with those.
Vehicle with_found(Vehicle vehicle, const FoundByLadder& found);
std::vector<double> with_found(std::vector<double> p, const FoundByLadder& found);

/// Constants of a model that is judged by the rest of the flight, with those of the first part.
std::vector<double> by_first_part(std::vector<double> p, const FoundByLadder& found);

/// Those in place of what forces and moments make of them.
std::vector<Parameter> with_found(std::vector<Parameter> parameters, const FoundByLadder& found);

/// The verdict of forces and moments with what the motors contradict: each such constant is a cause, because
/// its effect was measured itself. What makes a lasting moment stays open.
Judged with_found(Judged verdict, const FoundByLadder& found);

}  // namespace ident
