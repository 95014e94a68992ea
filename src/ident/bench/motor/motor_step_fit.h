// The fit of the motor constants to step recordings, and of the static curve that goes with them.
#pragma once

#include <optional>
#include <vector>

#include "ident/bench/motor/motor_step_misfit.h"
#include "ident/bench/motor/motor_step_model.h"
#include "ident/lsq/least_squares.h"

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

/// A motor cannot answer before its command: a dead time that comes out below zero is taken as zero.
enum class DeadTime { free, zero };

/// A fitted motor.
struct MotorFit {
  StaticCurve curve = StaticCurve::proportional;
  Parameter dead_time;                          ///< never below 0
  std::optional<Parameter> negative_dead_time;  ///< what it was when it was free, where that is below 0
  LeastSquaresFit fit;
  MotorShape shape;
  std::vector<double> predicted;  ///< at the rows of all records, one after the other
  double edge_scatter = 0.0;      ///< s, of the dead times of single edges; 0: one for all
  std::vector<double> shifts;     ///< of each edge after the first, s beyond the dead time
  TransientMisfit transients;
  double widening = 1.0;  ///< of variances, for residuals of transients that go together
};

/// The simplest static curve that the data do not contradict (information criterion), with the motor's shape.
/// Searched for widely, unless a shape is known to be near.
MotorFit fit_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near = {});

/// A quick look: the richest static curve, noise taken as white.
MotorFit guess_motor(const std::vector<StepRecord>& records, const std::optional<MotorShape>& near = {});

/// The same static curve, with omega_m of edges down free (unknown `down_ratio`); nothing where all edges go
/// one way.
std::optional<MotorFit> fit_motor_directions(const std::vector<StepRecord>& records, const MotorFit& alike);

/// Does a recording speak against the motor's shape, whatever its levels, its start and its way down?
bool contradicts(const StepRecord& record, const MotorFit& motor);

}  // namespace ident
