// What each cause closes of the forces, or the moments, that a model misses, on flight it was not fitted to.
#pragma once

#include "ident/gap/evidence/shares.h"
#include "ident/gap/windows/window_search.h"

namespace ident {

/// Shares by cross-validation over five parts of the flight: every set of causes is fitted to four of them
/// and judged on the fifth. `before`, `after`, `floor`: root mean square of what is missed, m/s or rad/s.
struct WindowShares {
  GapShares shares;
  double before = kNaN, after = kNaN, floor = kNaN;
};

WindowShares window_shares(const WindowModel& model, const WindowSearch& search);

}  // namespace ident
