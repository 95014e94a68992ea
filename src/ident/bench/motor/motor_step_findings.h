// What a motor fit says beyond its constants: what cannot be told apart, spin-down against spin-up.
#pragma once

#include "ident/bench/motor/motor_step_response.h"
#include "ident/bench/motor/motor_step_static.h"
#include "ident/result/result.h"

namespace ident {

/// Marks what the data do not determine and names the combination that they do: warning `not_separable`.
void judge_separability(Result& result, const StepResponse& response, const MotorFit& motor);

/// Where steps have dead times of their own: the scatter as the deviation of `dead_time`, warning
/// `dead_time_varies`; warning `recorder_pauses` where rows are missing in the motor's answer.
void judge_dead_times(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor,
                      const StepResponse& response);

/// Warning `transient_misfit` with how far transients miss the motor's equation beyond the noise.
void judge_transients(Result& result, const MotorFit& motor);

/// Fits edges down apart from edges up: extra `spin`, warning `spin_asymmetry` where they differ.
void compare_directions(Result& result, const std::vector<StepRecord>& records, const MotorFit& motor);

/// Warning `static_curve` with how much of full scale a straight line misses.
void judge_static_curve(Result& result, const std::vector<StepRecord>& records, const StaticLine& line);

}  // namespace ident
