// `ident report`: everything that a campaign found on one page, or the parameters of a vehicle file.
#include "ident/report/report.h"

#include <cmath>

#include "command.h"
#include "ident/bench/slant/slant.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/report/campaign_report.h"
#include "ident/report/report_files.h"
#include "shell.h"

namespace ident::app {
namespace {

struct Options {
  std::string vehicle;
  std::string output;
};

/// A slant angle is of kT, kQ and the arm, which later commands change; NaN for a vehicle that has none.
double slant_of(const Vehicle& vehicle) {
  try {
    return estimate_slant(vehicle).parameters.front().value;
  } catch (const Error&) {
    return kNaN;
  }
}

void warn_of_old_slant(std::vector<Result>& chapters, const Vehicle& vehicle) {
  for (Result& chapter : chapters) {
    if (chapter.command != "slant" || chapter.parameters.empty()) continue;
    if (!(std::abs(slant_of(vehicle) - chapter.parameters.front().value) < 1e-6))
      chapter.warn("stale_result", "kT, kQ or the arm have changed since: run `ident slant` again.");
  }
}

Result report_campaign(const Options& options, Context& context) {
  const Campaign campaign = read_campaign();
  const Vehicle vehicle = campaign_vehicle(campaign);
  std::vector<Result> chapters = stored_results(".");
  if (chapters.empty())
    throw DataError(
        "nothing to report yet: run `ident thrust`, `ident motor` or `ident flightlog --refine` first");
  warn_of_old_slant(chapters, vehicle);
  Result summary = campaign_summary(vehicle, chapters);
  summary.inputs = {campaign.file, campaign.vehicle};
  add_provenance(summary, context);
  chapters.insert(chapters.begin(), summary);
  const std::string title = vehicle.name.empty() ? "Campaign" : vehicle.name;
  const std::vector<std::string> pages = options.output.empty()
                                             ? std::vector<std::string>{"report.html", "report.md"}
                                             : std::vector{options.output};
  for (const std::string& page : pages) {
    add_report(context.outputs, report_files(page, title, chapters));
    context.notices.push_back("wrote " + page);
  }
  return summary;
}

}  // namespace

Action report_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  CLI::Option* output =
      cli.add_option("--output,--report", options->output,
                     "where to write: .html, .md or .json; report.html and report.md without it")
          ->type_name("FILE")
          ->each(require_folder_of);
  cli.add_option("--vehicle", options->vehicle, "only list the parameters of a vehicle or parameter file")
      ->type_name("FILE")
      ->excludes(output);
  examples(cli, {{"ident report", "all results of the campaign in this folder, as report.html and report.md"},
                 {"ident report --vehicle falcon.yaml", "the parameters of a file as a table"}});
  return [options](Context& context) -> Outcome {
    if (!options->vehicle.empty()) return vehicle_summary(read_vehicle(options->vehicle));
    return report_campaign(*options, context);
  };
}

}  // namespace ident::app
