// What pushes a vehicle up or down in the mean of its flight. Gusts do not: it is thrust that is not as
// fitted.
#pragma once

#include <span>

#include "ident/flight/fit/mean_push.h"
#include "ident/result/result.h"

namespace ident {

/// Warns of a push that matters: with it no constant is known that sets the thrust, or is told by what thrust
/// does.
void warn_of_steady_push(Result& result, const SteadyPush& push, std::span<const FlightLog> logs,
                         double gravity);

}  // namespace ident
