// `ident slant`: the slant angle that decouples a 4SP quadrotor.
#include "ident/bench/slant/slant.h"

#include "command.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {
namespace {

struct Options {
  std::string vehicle, params;
};

/// Vehicle file with the parameter file laid over it; either may be missing.
Vehicle named_vehicle(const Options& options, Context& context) {
  if (options.params.empty()) return read_vehicle(options.vehicle);
  Vehicle found = read_vehicle(options.params);
  if (options.vehicle.empty()) return found;
  context.used.push_back(options.params);
  return with_parameters(read_vehicle(options.vehicle), found);
}

Outcome run(const Options& options, Context& context) {
  if (!options.vehicle.empty() || !options.params.empty()) {
    return estimate_slant(named_vehicle(options, context));
  }
  const std::optional<Campaign> campaign = find_campaign();
  if (!campaign) throw UsageError("name a vehicle with --vehicle: there is no ident.yaml in this folder");
  context.used.insert(context.used.end(), {campaign->file, campaign->vehicle, campaign->parameters});
  const Result result = estimate_slant(campaign_vehicle(*campaign));
  context.outputs.add(campaign->parameters, updated_parameters(*campaign, result));
  return result;
}

}  // namespace

Action slant_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  cli.add_option("--vehicle", options->vehicle, "vehicle file; default: that of ident.yaml")
      ->type_name("FILE");
  cli.add_option("--params", options->params, "parameter file, laid over the vehicle file")
      ->type_name("FILE");
  examples(cli, {{"ident slant", "for the vehicle of ident.yaml, from its kT, kQ and arm"},
                 {"ident slant --vehicle 4sp.yaml --params found.yaml", "for a vehicle with bench results"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
