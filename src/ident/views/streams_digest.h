// Streams of a log in a few numbers each, by which two readers of a format can be compared.
#pragma once

#include <nlohmann/json.hpp>

#include "ident/data/log_streams.h"
#include "ident/result/result.h"

namespace ident {

/// Per stream `samples`, `rate_hz` (mean; null below two samples) and `fields`: `n`, `first`, `last` and the
/// `sum` of what is finite, with the scale of the format applied. What is not finite is null.
nlohmann::ordered_json streams_digest(const LogStreams& log);

}  // namespace ident
