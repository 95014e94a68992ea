// The fit of the motor constants to step recordings, and of the static curve that goes with them.
#pragma once

#include <vector>

#include "ident/estimators/least_squares.h"
#include "ident/estimators/motor_step_model.h"

namespace ident {

/// How the steady speed follows from the command.
enum class StaticCurve {
  proportional,  ///< km delta
  line,          ///< Omega_0 + km delta
  cubic,         ///< a polynomial of third degree
  plateaus  ///< a level of its own for every plateau of the command: nothing static can bend the dynamics
};

/// Whether edges down have an omega_m of their own.
enum class SpinDirections { alike, apart };

/// A fitted motor.
struct MotorFit {
  StaticCurve curve = StaticCurve::proportional;
  LeastSquaresFit fit;
  MotorShape shape;
  std::vector<double> predicted;  ///< at the rows of all records, one after the other
};

/// The simplest static curve that the data do not contradict (information criterion), with the motor's shape.
MotorFit fit_motor(const std::vector<StepRecord>& records);

/// The same static curve, with omega_m of edges down free (unknown `down_ratio`).
MotorFit fit_motor_directions(const std::vector<StepRecord>& records, const MotorFit& alike);

}  // namespace ident
