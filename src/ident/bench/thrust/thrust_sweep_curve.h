// The static curve from command to rotor speed.
//
//   Omega = Omega_0 + km delta (1)
//
// [Phang 22] has no offset; command curves of speed controllers do.
#pragma once

#include <optional>

#include "ident/bench/thrust/thrust_sweep_rows.h"
#include "ident/lsq/least_squares.h"

namespace ident {

struct CommandCurve {
  LeastSquaresFit fit;               ///< unknowns km, Omega_0
  std::vector<double> delta, Omega;  ///< what was fitted
  double misfit_percent_fs = kNaN;   ///< of (1)
  double with_square_percent_fs = kNaN;
  bool falls = false;    ///< the speed falls with the command: nothing was fitted
  bool is_bent = false;  ///< a term in delta^2 is significant and matters
};

/// Nothing where the file has no command or fewer than three different ones.
std::optional<CommandCurve> command_curve(const SweepRows& rows);

}  // namespace ident
