// What a motor makes of a command: responses that its speed is a sum of, with their derivatives.
//
//     Omega(t) = sum_k c_k r_k(t) + Omega_start r_x(t) + Omega_dot_start r_v(t) (1)
//
// r_k answers the input signal k (the command itself, a constant, one plateau of the command, ...), delayed
// by the dead time, from rest; r_x and r_v answer the state at the first row. All obey [Phang 22] with
// omega_m, zeta_m, solved exactly between samples and delayed edges, whatever their distances.
#pragma once

#include <Eigen/Core>
#include <array>

#include "ident/bench/motor/motor_step_record.h"

namespace ident {

/// The constants that enter nonlinearly.
struct MotorShape {
  double omega_m = 30.0;    ///< rad/s
  double zeta_m = 1.0;      ///< -
  double dead_time = 0.0;   ///< s; negative where time stamps of command and speed are shifted
  double down_ratio = 1.0;  ///< omega_m after an edge down over that after an edge up
};

/// Responses at the rows of a record: one row a sample, one column a signal, the two of the start last.
struct MotorResponses {
  Eigen::MatrixXd value;
  /// Derivatives with respect to omega_m, zeta_m, dead_time, down_ratio; empty unless asked for.
  std::array<Eigen::MatrixXd, 4> slope;
};

enum class Slopes { no, yes };

/// `inputs(e, k)` is the value of input signal k from edge e of the record on.
MotorResponses motor_responses(const StepRecord& record, const Eigen::MatrixXd& inputs,
                               const MotorShape& shape, Slopes slopes);

/// Answer to a unit step of the command at t = 0, from rest, and its derivatives with respect to t, omega_m,
/// zeta_m, dead_time.
struct StepAnswer {
  double value = 0.0, rate = 0.0;
  std::array<double, 3> slope{};
};
StepAnswer step_answer(const MotorShape& shape, double t);

}  // namespace ident
