// Tables and pictures of a motor fit.
#pragma once

#include "ident/bench/motor/motor_step_response.h"
#include "ident/bench/motor/motor_step_static.h"
#include "ident/result/result.h"

namespace ident {

std::vector<Section> motor_sections(const std::vector<StepRecord>& records, const MotorFit& motor,
                                    const StepResponse& response, const StaticLine& line);

}  // namespace ident
