// Constants of the DC motor from a sweep with duty, voltage, current and shaft torque.
//
//   delta V = R I + kv Omega      [Phang 20], [Selby]             (1)
//   torque = ki (I - I0)          no-load current [Selby]         (2)
//
// V is the battery's side, delta V what the motor sees on average, I the current through the motor. A stand
// measures the current before the speed controller, which passes power on: V I_battery = delta V I, so I =
// I_battery/delta. Both readings of the current column are tried, and the one that explains the data is
// taken. Gear ratio 1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/lsq/least_squares.h"
#include "ident/result/result.h"

namespace ident {

/// Rows of one sweep at steady speed; NaN where something is missing. Torque has its tare taken off.
struct MotorRows {
  std::vector<double> delta, voltage, current, Omega, torque;
  bool in_time_order = true;
};

enum class CurrentSide { motor, battery };

struct MotorConstants {
  /// ki, kv, R, I0; not identifiable, and why, where the data do not tell.
  std::vector<Parameter> parameters;
  std::optional<CurrentSide> side;  ///< on which the current was measured
  bool side_is_clear = false;
  std::string missing;  ///< what the data lack, in words; empty when all four are found
};

/// Nothing when the sweep has neither voltage nor current.
std::optional<MotorConstants> motor_constants(const MotorRows& rows);

}  // namespace ident
