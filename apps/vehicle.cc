// `ident vehicle`: drafts a vehicle file from what logs say of the vehicle.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command.h"
#include "ident/io/draft/draft_vehicle.h"
#include "ident/io/log_formats/read_log_streams.h"

namespace ident::app {
namespace {

struct Options {
  std::vector<std::string> logs;
  std::string output;
};

Outcome run(const Options& options, Context& context) {
  std::vector<LogStreams> logs;
  for (const std::string& file : options.logs) logs.push_back(read_log_streams(file));
  const VehicleDraft draft = draft_vehicle(logs);
  Result result{.command = "vehicle", .inputs = options.logs};
  result.extra["vehicle"] = draft.yaml;
  result.extra["fill_in"] = draft.fill_in;
  const std::string fill_in = fmt::format("fill in: {}", fmt::join(draft.fill_in, ", "));
  for (const std::string& notice : draft.notices) result.warn("other_frame", notice);
  context.notices.insert(context.notices.end(), draft.notices.begin(), draft.notices.end());
  if (options.output.empty()) {
    context.print = draft.yaml;
    context.notices.push_back(fill_in);
  } else {
    context.outputs.add(options.output, draft.yaml);
    result.verdict = fmt::format("{} is drafted; {}.", options.output, fill_in);
  }
  return result;
}

}  // namespace

Action vehicle_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  cli.add_option("LOG", options->logs, "logs of one vehicle: .ulg, .bin, a Crazyflie's card file")
      ->required()
      ->type_name("LOG");
  cli.add_option("-o,--output", options->output, "file to write; none: standard output")->type_name("FILE");
  examples(cli, {{"ident vehicle flight.ulg -o vehicle.yaml", "geometry, spin and range of commands"},
                 {"ident gap flight.ulg --vehicle vehicle.yaml", "once its mass is filled in"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
