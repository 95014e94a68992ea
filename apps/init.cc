// `ident init`: lays out a campaign from the files of a folder.
#include "command.h"
#include "ident/io/campaign/lay_out.h"
#include "ident/views/campaign_layout.h"

namespace ident::app {
namespace {

struct Options {
  std::string folder = ".", vehicle;
};

Outcome run(const Options& options, Context& context) {
  const LaidOutCampaign layout = lay_out_campaign(options.folder, options.vehicle);
  Result result{.command = "init"};
  for (const FoundFile& file : layout.taken) result.inputs.push_back(file.path);
  result.extra = layout_json(layout, options.folder);
  context.outputs.add(layout.campaign.file, layout.text);
  if (!layout.drafted.empty()) context.outputs.add(layout.campaign.vehicle, layout.drafted);
  result.warnings = layout.warnings;
  context.notices = layout.notices;
  context.print = layout_text(layout, options.folder);
  return result;
}

}  // namespace

Action init_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  cli.add_option("FOLDER", options->folder, "where logs and bench files lie; default: this folder")
      ->type_name("FOLDER");
  cli.add_option("--vehicle", options->vehicle, "vehicle file, where several lie there")->type_name("FILE");
  examples(cli, {{"ident init flights", "flights/ident.yaml, and a vehicle file drafted from the logs"},
                 {"ident init . --vehicle falcon.yaml", "where several vehicle files lie"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
