// Warnings about one sweep.
#pragma once

#include "ident/bench/thrust/thrust_sweep_file.h"

namespace ident {

/// What a user should know about the file, each by its code.
void add_sweep_warnings(const SweepFile& file, std::vector<Warning>& warnings);

}  // namespace ident
