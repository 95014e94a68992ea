// One thrust sweep, row by row: speed, force, torque and command, at rest or at which set-point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Columns that the file does not have are empty. NaN where a row has no value.
struct SweepRows {
  std::string file;
  bool is_log = false;  ///< sampled in time, many rows to a set-point; else rows taken by hand or script
  std::vector<double> place;  ///< s in a log, else the row's number
  std::vector<double> Omega;
  std::vector<double> thrust, torque;  ///< N, N m, as in the file: tare and sign not corrected
  std::vector<double> delta, voltage, current;
  /// Rows with the same number saw the same steady speed; -1: on the way to another one (logs), or a
  /// set-point of its own (tables).
  std::vector<int> set_point;
  int set_points = 0;
  std::vector<bool> at_rest;  ///< the rotor stands, beyond doubt
  std::size_t doubtful_rest = 0, spikes = 0, filled = 0;
  std::size_t missed = 0;  ///< speed 0 at commands at which the rotor turns elsewhere
  std::string speed_column;
  bool pulse_without_range = false;  ///< `u` is there, but not which pulse widths mean 0 and 1

  std::size_t size() const { return Omega.size(); }
};

/// Reads a table into rows: which speed to trust, spikes and gaps, command from pulse width, set-points,
/// rest. Throws DataError when the speed is not usable or there is no thrust.
SweepRows sweep_rows(const NumberTable& table, const std::optional<CommandRange>& command,
                     std::vector<Warning>& warnings);

/// Numbers the steady stretches of a log: the speed has stayed within a tolerance for `settle` seconds before
/// a row (a load cell answers late) and shortly after it.
void number_dwells(SweepRows& rows, double settle);

/// Numbers rows of a table that were taken at one set-point: neighbours with the same command, or, without a
/// command, with speeds that differ far less than set-points do.
void number_repeats(SweepRows& rows);

}  // namespace ident
