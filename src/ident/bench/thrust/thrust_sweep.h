// Thrust and torque constant of a propeller from bench sweeps, with everything that can be wrong with them.
#pragma once

#include <optional>
#include <vector>

#include "ident/data/table.h"
#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

struct ThrustOptions {
  std::optional<CommandRange> command;  ///< pulse widths of command 0 and 1, for files with `u`
  std::optional<double> radius;         ///< of the propeller, m: gives CT, CQ and the figure of merit
  double rho = 1.225;                   ///< density of the air, kg/m^3
  std::optional<double> hover_thrust;   ///< of one rotor, N: gives the power at hover
};

/// Options that a vehicle file answers.
ThrustOptions thrust_options(const Vehicle& vehicle);

/// Parameters kT, kQ (over all files), CT, CQ, figure_of_merit, km, Omega_0, ki, kv, R, I0, as far as the
/// files hold them; `quadratic_law`, `sweeps` and `hover` in `extra`. A file that cannot be used is left out
/// with a warning where there are others. Throws DataError when none can.
Result estimate_thrust(const std::vector<NumberTable>& tables, const ThrustOptions& options = {});

}  // namespace ident
