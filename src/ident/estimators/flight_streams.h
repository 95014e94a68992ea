// Streams of one log that came by different ways: motion capture and radio, filters of one sensor only.
#pragma once

#include <span>
#include <vector>

#include "ident/estimators/flight_record.h"
#include "ident/estimators/flight_stream_offset.h"

namespace ident {

/// The rates against the attitude, the specific force against the velocity, and rotor speeds against the
/// specific force, over all logs: what comes by one way is late in all of them.
struct StreamOffsets {
  StreamOffset rates, force, speeds;
};
StreamOffsets stream_offsets(const FlightRecord& record, double gravity);

/// The logs with their streams at one time: rates and specific force that are late as by a filter are moved
/// to the attitude, or else attitude, velocity and position to the rates, then the specific force to them
/// and rotor speeds that are late to that, where an offset matters; each move is a warning `stream_offset`.
/// Empty where nothing has to be moved.
std::vector<FlightLog> aligned_streams(const FlightRecord& record, std::span<const FlightLog> logs,
                                       double gravity, std::vector<Warning>& warnings);

}  // namespace ident
