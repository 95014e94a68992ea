// Signals of a flight log out of the streams of a log, each with its own times.
#pragma once

#include <string>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/io/log/log_signals.h"
#include "ident/io/log/read_flight_log.h"

namespace ident {

/// Samples of one signal in SI units, in the order of time; what was not sampled is left out.
struct StreamSignal {
  std::string name;
  LogGroup group = LogGroup::time;
  std::string stream, column;  ///< where they come from
  std::vector<double> t, values;
  double unfiltered = 0.0;  ///< lag of a low-pass that was taken back, s; 0: none
};

struct StreamSignals {
  std::vector<StreamSignal> list;
  std::vector<Warning> warnings;

  const StreamSignal* find(std::string_view name) const;
};

/// Throws InputError where a user's map names what the log does not hold, or a unit that is not known.
StreamSignals stream_signals(const LogStreams& log, const LogMap& map);

/// Whether a log has the stream and field of a line of a map, or of one of its alternatives.
bool has_signal(const LogStreams& log, const LogMap& map, const MappedColumn& mapped);

/// The stream of a name, or its first instance: `vehicle_attitude` is `vehicle_attitude:0`. Of several logs
/// in a file the longest: `main` is `2:main` where that has the most samples. A topic of ROS has the name
/// that it ends with, without its version: `vehicle_status` is `/fmu/out/vehicle_status_v1`.
const LogStream* find_stream(const LogStreams& log, const std::string& name);

}  // namespace ident
