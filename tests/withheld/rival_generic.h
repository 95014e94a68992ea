// What is left in a residual: shares of its smoothed power, and what a generic regression finds there.
#pragma once

#include "rival_fit.h"

namespace rival {

// Largest share, over the series, of the smoothed residual's power that went from `before` to `after`.
double material_share(const std::vector<Series>& before, const std::vector<Series>& after);

// The same over all series together, each in units of its white noise, which is taken off.
double closed_share(const std::vector<Series>& before, const std::vector<Series>& after);

// Held-out log-likelihood that a regression of the residual on motion, rotor speeds, height, voltage and time
// wins.
double generic_gain(const std::vector<Log>& logs, const std::vector<Series>& residuals);

}  // namespace rival
