// `ident check`: physical consistency of a vehicle or parameter file.
#include "command.h"
#include "ident/bench/check/consistency.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"

namespace ident::app {
namespace {

Vehicle judged(const std::string& file, Context& context) {
  if (!file.empty()) return read_vehicle(file, VehicleUse::judging);
  const std::optional<Campaign> campaign = find_campaign();
  if (!campaign) throw UsageError("name a vehicle or parameter file: there is no ident.yaml here");
  context.used.insert(context.used.end(), {campaign->file, campaign->vehicle, campaign->parameters});
  return campaign_vehicle(*campaign);
}

}  // namespace

Action check_command(CLI::App& cli) {
  auto file = std::make_shared<std::string>();
  cli.add_option("FILE", *file, "vehicle or parameter file; default: the vehicle of ident.yaml");
  examples(cli, {{"ident check falcon.yaml", "can it fly, and can a body have this inertia?"}});
  return [file](Context& context) -> Outcome {
    Result result = check_consistency(judged(*file, context));
    const bool violated = !result.extra["violations"].empty();
    return {std::move(result), violated ? ExitStatus::data_do_not_allow : ExitStatus::done};
  };
}

}  // namespace ident::app
