// Streams of one log that came by different ways: motion capture and radio, filters of one sensor only.
#pragma once

#include <span>
#include <vector>

#include "ident/estimators/flight_record.h"

namespace ident {

/// How much later than another stream of the same log one stream shows the same motion.
struct StreamOffset {
  double seconds = 0.0, std = kNaN;  ///< NaN: the log cannot tell

  /// Beyond doubt, at least so short, s, and enough to matter at this interval between rows.
  bool matters(double interval, double shortest) const;
};

/// The rates against the attitude, and the specific force against the velocity, over all logs: what comes by
/// one way is late in all of them.
struct StreamOffsets {
  StreamOffset rates, force;
};
StreamOffsets stream_offsets(const FlightRecord& record, double gravity);

/// The logs with their streams at one time: rates and specific force that are late as by a filter are moved
/// to the attitude, or else attitude, velocity and position to the rates, then the specific force to them,
/// where an offset matters; each move is a warning `stream_offset`. Empty where nothing has to be moved.
std::vector<FlightLog> aligned_streams(const FlightRecord& record, std::span<const FlightLog> logs,
                                       double gravity, std::vector<Warning>& warnings);

}  // namespace ident
