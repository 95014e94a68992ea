// From residuals to an estimate: robust start, outliers and noise in turn with the solution, then
// uncertainty.
#pragma once

#include "ident/lsq/least_squares.h"

namespace ident {

LeastSquaresFit solve_least_squares(const LeastSquaresProblem& problem,
                                    const LeastSquaresOptions& options = {});

}  // namespace ident
