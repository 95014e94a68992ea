// Motor constants from recordings of command steps.
#pragma once

#include <optional>
#include <vector>

#include "ident/data/table.h"
#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

struct MotorOptions {
  std::optional<CommandRange> command = {};  ///< pulse widths that mean 0 and 1, for files with `u`
};

/// km, omega_m, zeta_m, dead_time (and Omega_0 where the data show one) from all recordings together; the
/// step response with its band, spin-up against spin-down. Throws DataError when nothing is commanded or
/// turns.
Result estimate_motor(const std::vector<NumberTable>& tables, const MotorOptions& options = {});

}  // namespace ident
