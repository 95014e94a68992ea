// What a motor fit says beyond its constants: what cannot be told apart, spin-down against spin-up.
#pragma once

#include "ident/bench/motor/motor_step_response.h"
#include "ident/bench/motor/motor_step_static.h"
#include "ident/result/result.h"

namespace ident {

/// Marks constants that the data do not determine, and names the combination that they do: warning
/// `not_separable`.
void judge_separability(Result& result, const StepResponse& response);

/// Fits edges down apart from edges up: extra `spin`, warning `spin_asymmetry` where they differ.
void compare_directions(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor);

/// Warning `static_curve` with how much of full scale a straight line misses.
void judge_static_curve(Result& result, const std::vector<StepRecord>& records, const StaticLine& line);

}  // namespace ident
