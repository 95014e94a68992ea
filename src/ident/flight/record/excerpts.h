// Parts of a record: held-out flight, excerpts, pieces of arcs.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// The record without its arcs.
FlightRecord without_arcs(const FlightRecord& record);

/// End (s) of the first `training_share` of an arc's time.
double training_end(const FlightArc& arc, double training_share);

/// What comes before it, of every arc that is long enough to be one.
FlightRecord training_of(const FlightRecord& record, double training_share);

/// The rest of every arc after `training_share` of its time.
FlightRecord held_out_of(const FlightRecord& record, double training_share);

/// Stretches of about `seconds` each, evenly spread, that make `share` of the flight. Some short arcs are
/// taken whole. Every log has a part.
FlightRecord excerpt_of(const FlightRecord& record, double share, double seconds);

}  // namespace ident
