// Maps that the project ships for the logs of autopilots.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ident/io/log/read_flight_log.h"

namespace ident {

/// The profile of a log's format with a user's map laid over it line by line: a signal that the user names,
/// or says is not to be read, is his. Of several profiles the one of which the log has the most. Without a
/// profile the user's map alone. Throws UsageError where there is neither.
LogMap map_for_log(const LogStreams& log, const std::optional<LogMap>& user);

/// The map of a CSV whose columns bear the names of a profile's variables, as the Crazyflie's client writes
/// them: the lines without a stream whose column is there. Empty where fewer than two are.
std::optional<LogMap> map_for_header(const std::vector<std::string>& header);

}  // namespace ident
