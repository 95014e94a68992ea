// A flight log from CSV, with or without a map of its names, units and frames.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/io/log/frames.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Where a signal stands in a file: value = scale * number + offset, then the unit is converted. An empty
/// column
/// (`x: null` in the file) says that the signal is not to be read.
struct MappedColumn {
  std::string column;
  std::string unit;  ///< of the scaled number; empty: the header's, else the signal's own
  double scale = 1.0, offset = 0.0;
  long line = 0;  ///< in the map file, for messages
};

/// A map file: which column is which signal, in which unit and frame, and which part of the log to use. A
/// group of signals (rates, attitude, ...) of which the map names none is still found under its own names.
struct LogMap {
  std::string file;
  std::map<std::string, MappedColumn> columns;  ///< by signal: t, p, ax, delta1, qw, ...
  BodyFrame body = BodyFrame::frd;
  WorldFrame world = WorldFrame::ned;
  std::vector<std::array<double, 2>> windows;  ///< s, of the log's own clock
  long windows_line = 0;
};

/// Reads a log in SI units, FRD and NED. The number of command columns has to be that of the vehicle's
/// rotors; pulse widths need the vehicle's `command`. Rows with the same time stamp are put together,
/// commands are held until the next one, and values that a log merely repeats between two samples of a slower
/// sensor become NaN. Throws InputError or DataError.
FlightLog read_flight_log(const std::string& path, const Vehicle& vehicle, const std::optional<LogMap>& map);

}  // namespace ident
