// What the flight commands share: logs and vehicle named on the command line or from the campaign.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "ident/data/flight_log.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/campaign/flight_history.h"

namespace ident::app {

struct FlightOptions {
  std::vector<std::string> files, maps;           ///< one map for all of the files, or one for each
  std::vector<std::string> motions, motion_maps;  ///< recordings of motion capture, one for each of the files
  std::string vehicle, params;
};

void add_flight_options(CLI::App& cli, FlightOptions& options);

/// Which model a command starts from: the campaign's as it is stored, or what was known before these logs,
/// where the logs are to be evidence. An estimate that came from a log must not be a prior for the same log.
enum class Model { as_stored, before_these_logs };

struct FlightInput {
  Vehicle vehicle;
  std::vector<FlightLog> logs;
  std::optional<Campaign> campaign;  ///< set when logs and vehicle came from it: results are stored there
  FlightHistory history;             ///< what is stored with them, but for what the refinement finds
  std::vector<Warning> warnings;     ///< of what was known before
};

/// Reads them; without a file the campaign's logs, without --vehicle its vehicle. Throws UsageError when
/// there is none.
FlightInput flight_input(const FlightOptions& options, Model model, Context& context);

/// Takes out logs in which nothing flew, each with a notice. Throws DataError where none is left.
void leave_out_unflown(FlightInput& input, Context& context);

}  // namespace ident::app
