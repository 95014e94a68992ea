// The answer of a fitted motor to a step of its command, with its band: what is known even where omega_m and
// zeta_m are not.
#pragma once

#include <vector>

#include "ident/bench/motor/motor_step_fit.h"
#include "ident/result/result.h"

namespace ident {

/// Share of the way to the new speed over the time since the command changed.
struct StepResponse {
  std::vector<double> t, value, std;
  Parameter rise_time;      ///< from 10 % to 90 %, s
  Parameter time_constant;  ///< from the end of the dead time to 63.2 %, s
  Parameter lag;            ///< 2 zeta_m/omega_m, s: the mean delay of the motor without its dead time
  Parameter total_lag;      ///< 2 zeta_m/omega_m + dead_time, s
};

StepResponse step_response(const MotorFit& motor);

}  // namespace ident
