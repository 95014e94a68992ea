// Streams of one log that came by different ways: motion capture and radio, filters of one sensor only.
#pragma once

#include <span>
#include <vector>

#include "ident/flight/conditioning/stream_offset.h"
#include "ident/flight/record/flight_record.h"

namespace ident {

/// The rates against the attitude, the specific force against the motion along the path, and rotor speeds
/// against the specific force and, by their moments about x and y, against the rates, over all logs: what
/// comes by one way is late in all of them.
struct StreamOffsets {
  StreamOffset rates, force, speeds, moments;
};
StreamOffsets stream_offsets(const FlightRecord& record, double gravity);

/// The logs with their streams at one time, where an offset matters; each move is a warning `stream_offset`.
/// Rates and specific force that are late as by a filter, or against rotor speeds too, are moved to the
/// attitude, or else attitude, velocity and position to the rates. What is then left between force and
/// velocity moves the force, or the path where rotor speeds say that the force is in time; rotor speeds that
/// are late to the force, and as late to the rates where these tell, move last.
struct AlignedStreams {
  std::vector<FlightLog> logs;  ///< empty where nothing has to be moved
  double turns_apart = 0.0;  ///< s between what rates and attitude show, as given; 0 where that may be chance
};
AlignedStreams aligned_streams(const FlightRecord& record, std::span<const FlightLog> logs, double gravity,
                               std::vector<Warning>& warnings);

}  // namespace ident
