// Edges of the command that each have a dead time of their own.
//
// A recorder that writes the command before it sends it, or pauses while it does, shows every step at another
// distance from the motor's answer. Edge e is then at t_e + dead_time + shift_e.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/bench/motor/motor_step_model.h"

namespace ident {

/// Edges after the first one (which only says what holds at the start), over all records.
std::size_t count_steps(const std::vector<StepRecord>& records);

/// The record with its edges, but for the first, moved by `shift`; their order stays.
StepRecord with_shifted_edges(StepRecord record, const Eigen::VectorXd& shift);

/// Derivative of the speed at each row with respect to the time of each edge but the first. `target` holds
/// from edge to edge; `start` is speed and rate at the first row.
///
///     dx(t)/dt_e = Phi(t - t_e) (f_before(x(t_e)) - f_after(x(t_e))) (1)
///
/// with x = (Omega, Omega'), f its rate under the motor's equation, Phi the transition of the motor.
Eigen::MatrixXd edge_time_slopes(const StepRecord& record, const Eigen::VectorXd& target,
                                 const Eigen::Vector2d& start, const MotorShape& shape);

/// Steps around which the recording has no rows for long, though it has elsewhere.
struct RecorderPauses {
  std::size_t steps = 0;  ///< that have a pause in the time of the motor's answer
  double longest = 0.0;   ///< s
  double usual = 0.0;     ///< s, median distance of rows
};
RecorderPauses recorder_pauses(const std::vector<StepRecord>& records, double answer_time);

}  // namespace ident
