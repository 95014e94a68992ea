// Cuts a log into arcs: uninterrupted pieces in flight.
#pragma once

#include <utility>
#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// Rows [first, second).
using Pieces = std::vector<std::pair<std::size_t, std::size_t>>;

/// The rows of a log in flight, in pieces without a hole. Each begins `history` seconds after the commands
/// are known. Where that would cost much of the flight, commands are held over holes of up to `longest_gap`
/// seconds instead, with a warning.
Pieces whole_pieces(const FlightLog& log, double history, double longest_gap, std::vector<Warning>& warnings);

}  // namespace ident
