// Made-up results with every kind of table and plot, to look at reports without running an estimator.
#pragma once

#include "ident/result/result.h"

namespace ident::testing {

/// As a flight log refinement would give it: time series of two rates, fits, residuals, correlation.
Result sample_parameter_result();

/// As a gap diagnosis would give it: waterfall, shares, signature, heat map, table of effects.
Result sample_gap_result();

/// Six series of 100,000 samples.
Result large_result();

}  // namespace ident::testing
