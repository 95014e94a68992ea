// The steady speed over the command, and km and Omega_0 as its straight line.
#pragma once

#include <optional>
#include <vector>

#include "ident/bench/motor/motor_step_fit.h"
#include "ident/result/correlation.h"
#include "ident/result/result.h"

namespace ident {

struct StaticLine {
  Parameter km;
  std::optional<Parameter> Omega_0;  ///< when the data show one
  Correlation correlation;           ///< of these and of the dynamics
  std::vector<double> delta, level;  ///< points of the curve, where it is not a line by construction
  double misfit = 0.0;               ///< RMS distance of the points from the line, rad/s
};

StaticLine static_line(const std::vector<StepRecord>& records, const MotorFit& motor);

}  // namespace ident
