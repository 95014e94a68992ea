// Reads the logs and the vehicle of a flight command.
#include "flight_input.h"

#include "ident/io/read_flight_log.h"
#include "ident/io/vehicle_file.h"

namespace ident::app {

void add_flight_options(CLI::App& cli, FlightOptions& options) {
  cli.add_option("LOG", options.files, "flight logs (CSV); none: those of ident.yaml")->type_name("LOG");
  cli.add_option("--vehicle", options.vehicle, "vehicle file; none: that of ident.yaml")->type_name("FILE");
  cli.add_option("--params", options.params, "parameter file, laid over the vehicle file")->type_name("FILE");
  cli.add_option("--map", options.map, "which column is which signal, in which unit and frame")
      ->type_name("FILE");
}

FlightInput flight_input(const FlightOptions& options, Context& context) {
  FlightInput input;
  const std::optional<Campaign> campaign = find_campaign();
  if (!options.vehicle.empty()) {
    input.vehicle = read_vehicle(options.vehicle);
    context.used.push_back(options.vehicle);
  } else if (campaign) {
    input.vehicle = campaign_vehicle(*campaign);
    context.used.push_back(campaign->file);
  } else {
    throw UsageError("no vehicle: name one with --vehicle FILE, or run where there is an ident.yaml");
  }
  if (!options.params.empty()) {
    input.vehicle = with_parameters(input.vehicle, read_vehicle(options.params));
    context.used.push_back(options.params);
  }
  std::vector<CampaignLog> logs;
  for (const std::string& file : options.files) logs.push_back({file, options.map});
  if (logs.empty() && campaign) {
    logs = campaign->logs;
    input.campaign = campaign;
  }
  if (logs.empty()) throw UsageError("no flight log: name one, or list `logs` in ident.yaml");
  for (const CampaignLog& log : logs) {
    std::optional<LogMap> map;
    if (!log.map.empty()) {
      map = read_log_map(log.map);
      context.used.push_back(log.map);
    }
    input.logs.push_back(read_flight_log(log.file, input.vehicle, map));
    for (const std::string& notice : input.logs.back().notices)
      context.notices.push_back(notice);
  }
  return input;
}

}  // namespace ident::app
