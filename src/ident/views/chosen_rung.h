// Constants of the chosen rung in place of those of a refinement that predicts worse.
#pragma once

#include "ident/flight/ladder/ladder.h"
#include "ident/result/result.h"

namespace ident {

/// Adds the ladder to a result. Where another rung than the full one is chosen, its constants take the place
/// of the refined ones; what it has not estimated is as stated, with a note why.
void settle_for_chosen(Result& result, const LadderResult& ladder, const Vehicle& vehicle);

}  // namespace ident
