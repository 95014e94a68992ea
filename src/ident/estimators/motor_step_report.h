// Tables and pictures of a motor fit.
#pragma once

#include "ident/core/result.h"
#include "ident/estimators/motor_step_response.h"
#include "ident/estimators/motor_step_static.h"

namespace ident {

std::vector<Section> motor_sections(const std::vector<StepRecord>& records, const MotorFit& motor,
                                    const StepResponse& response, const StaticLine& line);

}  // namespace ident
