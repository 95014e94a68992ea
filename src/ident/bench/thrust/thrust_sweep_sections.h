// Tables and pictures of thrust sweeps.
#pragma once

#include <vector>

#include "ident/bench/thrust/thrust_sweep_file.h"

namespace ident {

/// What each file found, one line a file.
Table sweep_table(const std::vector<SweepFile>& files);

/// How well the quadratic law holds, one line for each file and force.
Table law_table(const std::vector<SweepFile>& files);

/// Fit over data and the residuals of one file.
Section sweep_section(const SweepFile& file, std::size_t number);

}  // namespace ident
