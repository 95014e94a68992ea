// The results of one sweep file.
#pragma once

#include <optional>

#include "ident/bench/thrust/dc_motor.h"
#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/bench/thrust/thrust_sweep_curve.h"
#include "ident/bench/thrust/thrust_sweep_law.h"

namespace ident {

struct SweepFile {
  SweepRows rows;
  SweepPoints points;
  SweepFit fit, linear;  ///< quadratic law, and with the linear term
  LawJudgement thrust_law;
  std::optional<LawJudgement> torque_law;
  std::optional<CommandCurve> curve;
  bool command_falls = false;  ///< with rising speed: no curve
  std::optional<MotorConstants> motor;
  bool has_torque() const { return points.has_torque(); }
};

/// Throws DataError when the file does not tell kT.
SweepFile analyse_sweep(const NumberTable& table, const ThrustOptions& options,
                        std::vector<Warning>& warnings);

}  // namespace ident
