// The parameters of a result from all its sweeps.
#pragma once

#include <vector>

#include "ident/bench/thrust/thrust_sweep_file.h"

namespace ident {

/// Covariance of kT and kQ over files, weighted as they are pooled; some files may have no torque.
double thrust_torque_covariance(const std::vector<SweepFile>& files);

/// kT, kQ, CT, CQ, figure_of_merit, km, Omega_0 and the motor's constants, with the warnings that come with
/// them.
void add_sweep_parameters(Result& result, const std::vector<SweepFile>& files, const ThrustOptions& options);

}  // namespace ident
