// The refinement of flight whose turning the inputs do not explain: forces and moments along measured motion.
#pragma once

#include <optional>
#include <span>

#include "ident/data/flight_log.h"
#include "ident/flight/ladder/ladder.h"
#include "ident/flight/prepare.h"
#include "ident/flight/refine.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident {

inline constexpr double kLeastJudged = 6.0;  ///< s of flight, for a part of it to be held out

/// The model that the ladder has chosen, in a result that was begun. What is not of it keeps what was stated.
Result refined_along_motion(Result begun, const Vehicle& vehicle, std::span<const FlightLog> logs,
                            const FlightEntry& entry, const LadderResult& ladder, Shown shown);

/// The same from logs; none where the inputs explain some of the turning, or where the logs hold nothing to
/// estimate from.
std::optional<Result> refined_along_motion(const Vehicle& vehicle, std::span<const FlightLog> logs,
                                           const RefineOptions& options);

/// Whether a refinement goes no further than that.
bool ends_along_motion(const LadderResult& ladder, const FlightEntry& entry, const RefineOptions& options);

/// The ladder where a part of the flight can be held out to judge by, and is wanted.
std::optional<LadderResult> ladder_of(const FlightRecord& record, const RefineOptions& options);

}  // namespace ident
