// `ident check`: physical consistency of a vehicle or parameter file, and the list of all findings.
#include "command.h"
#include "ident/bench/check/consistency.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/views/findings_list.h"

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
  struct Options {
    std::string file, page;
    bool list = false;
  };
  auto options = std::make_shared<Options>();
  auto* const file =
      cli.add_option("FILE", options->file, "vehicle or parameter file; default: the vehicle of ident.yaml");
  auto* const list = cli.add_flag("--list", options->list, "explain every warning of every command instead");
  list->excludes(file);
  cli.add_option("--markdown", options->page, "with --list: also write the list as a page")
      ->type_name("FILE")
      ->needs(list);
  examples(cli, {{"ident check falcon.yaml", "can it fly, and can a body have this inertia?"},
                 {"ident check --list", "what does each warning mean, and what can be done?"}});
  return [options](Context& context) -> Outcome {
    if (!options->page.empty()) context.outputs.add(options->page, findings_page());
    if (options->list) return findings_list();
    Result result = check_consistency(judged(options->file, context));
    const bool violated = !result.extra["violations"].empty();
    return {std::move(result), violated ? ExitStatus::data_do_not_allow : ExitStatus::done};
  };
}

}  // namespace ident::app
