// Whether commands held from row to row as a log has them, or a controller that is faster than its log went
// on between them.
#pragma once

#include <span>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// How much better held commands explain a flight than commands that go on along a line to the next, each
/// with the dead time that suits it.
struct HeldCommands {
  double better = 0.0;    ///< fall of the cost
  double expected = 0.0;  ///< that, if they did hold: the square of what the two predictions differ by
  bool rare = false;  ///< logged more seldom than the rates that a controller answers to, and it would matter
  bool skipped = false;  ///< the log states that there were others, and it matters

  /// Whether the flight says that they did not: by more than chance, and by a good part.
  bool refuted() const;
  /// Whether it says that they did, beyond doubt.
  bool confirmed() const;
  /// Whether they are not to be relied on.
  bool doubtful() const { return refuted() || (rare && !confirmed()); }
};

/// Whether logs state that commands were skipped, and half the time between those that are there matters to
/// the motors with constants `p`.
bool skip_what_matters(const FlightRecord& record, std::span<const FlightLog> logs,
                       std::span<const double> p);

/// The same at a fit, its noise taken for known; expects nothing where commands hardly change from one to the
/// next, nothing is to be told from it, or logs have each command of a controller as they say. Takes two fits
/// of the dead time, none where a log states that commands were skipped.
HeldCommands commands_held(const FlightRecord& record, std::span<const FlightLog> logs, const Theta& theta,
                           const FlightFit& fit);

/// Where commands are doubtful, what follows them does not count as known, and a warning
/// `commands_between_rows` says so; where they come at less than 110 Hz, neither do moments of inertia, nor
/// does an offset of the command that such logs ask for, with what goes with it. Neither is such an offset
/// known where logs state that they skip commands.
void doubt_commands_between_rows(Result& result, const FlightRecord& record, std::span<const FlightLog> logs,
                                 const HeldCommands& held);

}  // namespace ident
