// `ident log`: what is in a log, what it can tell, and what to set for the next flight.
#include <optional>

#include "command.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/log_formats/read_log_streams.h"
#include "ident/io/rebuild/rebuilt_commands.h"
#include "ident/views/log_summary.h"
#include "ident/views/streams_digest.h"

namespace ident::app {
namespace {

struct Options {
  std::string log, map;
  bool streams = false;
};

Outcome run(const Options& options, Context& context) {
  LogStreams log = read_log_streams(options.log);
  const nlohmann::ordered_json digest = options.streams ? streams_digest(log) : nlohmann::ordered_json();
  const std::string table = options.streams ? streams_table(log) : "";
  add_rebuilt_commands(log);
  std::optional<LogMap> map;
  if (!options.map.empty()) {
    map = read_log_map(options.map);
    context.used.push_back(options.map);
  }
  std::optional<FlightLog> flight;
  std::string why;
  try {
    flight = flight_log_of(log, Vehicle{}, map);
  } catch (const Error& error) {
    why = error.what();  // a log without motors has streams nevertheless
  }
  const LogSummary summary = summarise_log(log, flight, why);
  Result result{.command = "log", .inputs = {options.log}};
  result.extra = summary.json;
  if (options.streams) result.extra["streams"] = digest;
  if (flight) result.warnings = flight->warnings;
  context.print = options.streams ? table : summary.text;
  return result;
}

}  // namespace

Action log_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  cli.add_option("LOG", options->log, "log of an autopilot: .ulg, .bin, .log, a Crazyflie's card file")
      ->required()
      ->type_name("LOG");
  cli.add_flag("--streams", options->streams, "every stream with its rate and fields");
  cli.add_option("--map", options->map, "which stream is which signal, where the profile has it otherwise")
      ->type_name("FILE");
  examples(cli, {{"ident log flight.ulg", "ten lines: rates, seconds in the air, what can be identified"},
                 {"ident log flight.ulg --streams", "every topic that was logged"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
