// What a plain regression on the flight still predicts of what is missed along measured motion.
#pragma once

#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/windows/window_model.h"

namespace ident {

/// Each axis of each side on velocity, rates, thrust and their products, height, voltage and time, fitted to
/// four parts of the flight and judged on the fifth.
Rival window_rival(const WindowModel& model, const WindowStanding& standing);

}  // namespace ident
