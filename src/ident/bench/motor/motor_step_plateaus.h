// Plateaus of the command in a step recording, and the rows of them that no longer tell of the motor.
#pragma once

#include <cstddef>
#include <vector>

#include "ident/bench/motor/motor_step_record.h"

namespace ident {

/// Rows [begin, end) of one value of the command.
struct Plateau {
  double delta = 0.0, level = 0.0;  ///< command; median speed of the second half
  std::size_t begin = 0, end = 0;
};

std::vector<Plateau> plateaus_of(const StepRecord& record);

/// Leaves out rows long after the speed has settled (many times the settling time) where a recording has
/// thousands of them: they repeat the level of the plateau. Returns how many were left out.
std::size_t leave_out_settled_rows(std::vector<StepRecord>& records);

}  // namespace ident
