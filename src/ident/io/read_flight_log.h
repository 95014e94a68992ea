// A flight log from CSV, with or without a map of its names, units and frames.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Where a signal stands in a file: value = scale * number + offset, then the unit is converted.
struct MappedColumn {
  std::string column;
  std::string unit;  ///< empty: the header's, else the signal's own
  double scale = 1.0, offset = 0.0;
  long line = 0;  ///< in the map file, for messages
};

/// Axes of the file's body frame: forward-right-down (ours), forward-left-up, and two more that occur.
enum class BodyFrame { frd, flu, rfu, bru };
/// Axes of the file's world frame: north-east-down (ours), east-north-up, north-west-up.
enum class WorldFrame { ned, enu, nwu };

/// A map file: which column is which signal, in which unit and frame, and which part of the log to use.
struct LogMap {
  std::string file;
  std::map<std::string, MappedColumn> columns;  ///< by signal: t, p, ax, delta1, qw, ...
  BodyFrame body = BodyFrame::frd;
  WorldFrame world = WorldFrame::ned;
  std::vector<std::array<double, 2>> windows;  ///< s, of the log's own clock
};

/// Reads a map (YAML: columns, frames, windows). Throws InputError.
LogMap read_log_map(const std::string& path);

/// Reads a log in SI units, FRD and NED. The number of command columns has to be that of the vehicle's
/// rotors; pulse widths need the vehicle's `command`. Throws InputError or DataError.
FlightLog read_flight_log(const std::string& path, const Vehicle& vehicle, const std::optional<LogMap>& map);

}  // namespace ident
