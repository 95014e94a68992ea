// When a vehicle flew, as its log tells.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/io/log/stream_signals.h"

namespace ident {

/// Intervals [from, until], s, by the first rule that the log has the data for; none of them: empty optional.
/// An empty list: the vehicle never flew.
std::optional<std::vector<std::array<double, 2>>> airborne(const LogStreams& log,
                                                           const std::vector<AirborneRule>& rules,
                                                           const StreamSignals& signals);

}  // namespace ident
