// A flight log from CSV, with or without a map of its names, units and frames.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/data/log_streams.h"
#include "ident/io/log/frames.h"
#include "ident/model/vehicle.h"

namespace ident {

/// A number that a field of a stream has to be.
struct StreamCondition {
  std::string field;
  double is = 0.0;
  bool of_output = false;  ///< `is` counts from the number of the output that drives the motor
};

/// A low-pass as a map names it: numbers, or parameters of the log.
struct MappedLowPass {
  std::string cutoff;  ///< Hz, of a Butterworth filter of second order
  std::string lag;     ///< s: y + lag y' + square y'' went in
  std::string square;  ///< s^2
};

/// Where a signal stands in a file: value = scale * number + offset, then the unit is converted. An empty
/// column (`x: null` in the file) says that the signal is not to be read. What speaks of streams is for logs
/// that hold some.
struct MappedColumn {
  std::string column;
  std::string unit;  ///< of the scaled number; empty: the header's, else the signal's own
  double scale = 1.0, offset = 0.0;
  long line = 0;                       ///< in the map file, for messages
  std::string stream;                  ///< empty: the one with the most samples of that column
  std::vector<StreamCondition> where;  ///< samples to take; one on a field that is not there does not count
  std::string time;                    ///< field with times of this column's own, in us as the stream's clock
  std::string late_by;                 ///< field of the time by which a sample is late
  double late_by_scale = 1.0;          ///< s per unit of it
  MappedLowPass behind;                ///< that the signal went through
  std::optional<double> nan_is;        ///< what a sample that is not a number stands for
  std::string by, per;                 ///< parameters of the log that a number is multiplied with, divided by
  std::array<std::string, 2> range;    ///< parameters that are 0 and 1 of the signal
  bool must_be_there = false;          ///< a user named it: an error where it is not
  int number = 0;                      ///< n, of a line that speaks of rotors as `delta{n}`
  std::vector<MappedColumn> otherwise;  ///< in order of preference, where stream or column are not there
};

/// How a log tells when the vehicle flies. Several of them are tried in turn.
struct AirborneRule {
  std::string stream, column;
  std::optional<double> is;           ///< value while it flies
  std::optional<double> from, until;  ///< or values of events: leaves the ground, is back on it
  double commands_above = 0.0;        ///< or, without a stream: mean command, 0 to 1
};

/// A map file: which column is which signal, in which unit and frame, and which part of the log to use. A
/// group of signals (rates, attitude, ...) of which the map names none is still found under its own names. A
/// profile is a map for the logs of an autopilot; a user's map overrides single lines of it.
struct LogMap {
  std::string file;
  std::map<std::string, MappedColumn> columns;  ///< by signal: t, p, ax, delta1, qw, ...
  BodyFrame body = BodyFrame::frd;
  WorldFrame world = WorldFrame::ned;
  std::vector<std::array<double, 2>> windows;  ///< s, of the log's own clock
  long windows_line = 0;
  bool states_body = false, states_world = false;
  std::vector<std::string> formats;          ///< of a profile: names of log_formats.def
  std::vector<AirborneRule> airborne;        ///< of a profile
  std::string output_function;               ///< parameter `SERVO{k}_FUNCTION` that says what output k drives
  std::vector<double> motor_functions;       ///< its values for motor 1, 2, ...
  std::vector<std::string> controller_rate;  ///< parameters with how often motors are told something, or Hz
  std::array<std::vector<std::string>, 2> command;  ///< parameters with the pulse widths of command 0 and 1
  std::vector<std::string> not_streams;             ///< words in the names of streams that are no measurement
};

/// Reads a log in SI units, FRD and NED: CSV, or any format of log_formats.def, by its profile. The number of
/// command columns has to be that of the vehicle's rotors; pulse widths need the vehicle's `command`. Rows
/// with the same time stamp are put together, commands are held until the next one, and values that a log
/// merely repeats between two samples of a slower sensor become NaN. Throws InputError or DataError.
FlightLog read_flight_log(const std::string& path, const Vehicle& vehicle, const std::optional<LogMap>& map);

/// The same from streams that were read.
FlightLog flight_log_of(const LogStreams& log, const Vehicle& vehicle, const std::optional<LogMap>& map);

/// Attitude, position and velocity alone, from the same kinds of files: a motion capture's recording of a
/// flight. Throws InputError where the file has no attitude.
FlightLog read_motion(const std::string& path, const std::optional<LogMap>& map);

}  // namespace ident
