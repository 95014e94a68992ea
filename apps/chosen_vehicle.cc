// Reads the vehicle that a command works with.
#include "chosen_vehicle.h"

#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {

void add_vehicle_options(CLI::App& cli, std::string& vehicle, std::string& params) {
  cli.add_option("--vehicle", vehicle, "vehicle file, or a simulator's; none: that of ident.yaml")
      ->type_name("FILE");
  cli.add_option("--params", params, "parameter file, laid over the vehicle file")->type_name("FILE");
}

Vehicle chosen_vehicle(const std::string& file, const std::string& params, Context& context) {
  Vehicle vehicle;
  if (!file.empty()) {
    vehicle = read_vehicle(file);
    context.used.push_back(file);
  } else if (const std::optional<Campaign> campaign = find_campaign()) {
    vehicle = campaign_vehicle(*campaign);
    context.used.insert(context.used.end(), {campaign->vehicle, campaign->parameters});
  } else {
    throw UsageError("no vehicle: name one with --vehicle FILE, or run where there is an ident.yaml");
  }
  if (params.empty()) return vehicle;
  context.used.push_back(params);
  return with_parameters(vehicle, read_vehicle(params));
}

}  // namespace ident::app
