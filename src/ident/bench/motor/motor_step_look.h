// A first look at step recordings: which rows the fit takes, at which times, and where its search begins.
#pragma once

#include <optional>
#include <vector>

#include "ident/bench/motor/motor_step_fit.h"
#include "ident/result/result.h"

namespace ident {

/// Records as the fit takes them.
struct FirstLook {
  std::vector<StepRecord> records;
  std::optional<MotorShape> near = {};  ///< the motor's shape, where a quick fit was needed to judge the rows
  double sigma = 0.0;                   ///< what that fit left over, rad/s
};

/// Leaves out rows that are not the motor's answer (not driven, though the model does not hold there), rows
/// long settled, and gives bursts of rows even times. Decisions are added to `warnings`.
FirstLook look_at_records(std::vector<StepRecord> records, std::vector<Warning>& warnings);

}  // namespace ident
