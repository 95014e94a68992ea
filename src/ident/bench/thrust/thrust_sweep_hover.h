// Power of a rotor at hover: what momentum theory asks for, what the shaft takes, what the battery gives.
#pragma once

#include "ident/bench/thrust/thrust_sweep_file.h"

namespace ident {

/// Adds `hover` to the result and a table to the section, where mass (thrust of a rotor) and kT are known.
void add_hover(Result& result, const std::vector<SweepFile>& files, const ThrustOptions& options,
               Section& section);

/// Electrical power, W, at a rotor speed, interpolated between the set-points of a file; NaN outside them.
double electrical_power(const SweepRows& rows, double Omega);

}  // namespace ident
