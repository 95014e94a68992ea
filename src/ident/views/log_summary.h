// A log in ten lines: what it holds, what can be identified from it, and what to set for the next flight.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "ident/data/flight_log.h"
#include "ident/data/log_streams.h"
#include "ident/result/result.h"

namespace ident {

struct LogSummary {
  std::string text;  ///< at most ten lines
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
};

/// `flight` is what the profile made of the log; empty where that failed, for the reason `why`.
LogSummary summarise_log(const LogStreams& log, const std::optional<FlightLog>& flight,
                         const std::string& why);

/// One line for each stream: samples, rate, fields.
std::string streams_table(const LogStreams& log);

}  // namespace ident
