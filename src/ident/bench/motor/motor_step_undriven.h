// Stretches of a step recording in which the motor is not driven: standing, starting from rest, coasting.
#pragma once

#include <string>
#include <vector>

#include "ident/bench/motor/motor_step_record.h"

namespace ident {

/// Rows [begin, end) of a record in which the motor is not driven. Its equation is that of a speed controller
/// at work. It need not hold while a command of 0 lets the motor coast, nor while a standing motor starts.
struct UndrivenStretch {
  enum class Kind {
    coasting,   ///< the command means "off": it is not above 0, or the motor stands at its end
    from_rest,  ///< from such a command until the speed first reaches its new level
  };
  Kind kind = Kind::coasting;
  std::size_t record = 0, begin = 0, end = 0;
};

/// In the order of records and rows.
std::vector<UndrivenStretch> undriven_stretches(const std::vector<StepRecord>& records);

/// The records without those rows; a record falls into the parts that are left, too short ones vanish.
std::vector<StepRecord> without(const std::vector<StepRecord>& records,
                                const std::vector<UndrivenStretch>& stretches);

/// The stretch with some rows before it, so that a delayed edge at its begin is in it.
StepRecord with_approach(const std::vector<StepRecord>& records, const UndrivenStretch& stretch);

/// Is there an edge of the command from which a motor can be told?
bool has_edges(const std::vector<StepRecord>& records);

}  // namespace ident
