// Input of the bench commands, and where their estimates go.
#include "bench.h"

#include <utility>

#include "campaign_priors.h"
#include "ident/io/csv/table_map.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"

namespace ident::app {

void add_bench_options(CLI::App& cli, BenchOptions& options, const std::string& what_the_files_are) {
  cli.add_option("FILE", options.files, what_the_files_are + "; without one those of ident.yaml");
  cli.add_option("--vehicle", options.vehicle, "vehicle file (gravity, command range)")->type_name("FILE");
  cli.add_option("--map", options.map, "map file: which column is which signal, in which unit")
      ->type_name("FILE");
  cli.add_option(
         "--header", options.names,
         "names of the columns of files without a header, as \"pwm,thrust_gf,rpm\"; lines before the first "
         "row are passed over")
      ->type_name("NAMES");
}

BenchInput bench_input(const BenchOptions& options, const TableSchema& schema, const std::string& key,
                       std::vector<std::string> Campaign::*listed, Context& context) {
  BenchInput input;
  std::vector<std::string> files = options.files;
  if (files.empty()) {
    input.campaign = find_campaign();
    if (!input.campaign)
      throw UsageError("no file is named, and there is no ident.yaml in this folder to take one from");
    files = (*input.campaign).*listed;
    if (files.empty()) throw UsageError(input.campaign->file + ": " + key + ": names no file");
    context.used.push_back(input.campaign->file);
  }
  if (!options.vehicle.empty()) {
    input.vehicle = read_vehicle(options.vehicle);
    context.used.push_back(options.vehicle);
  } else if (input.campaign) {
    input.vehicle = campaign_vehicle(*input.campaign);
    context.used.insert(context.used.end(), {input.campaign->vehicle, input.campaign->parameters});
  }
  std::optional<TableMap> map;
  if (!options.map.empty()) {
    map = read_table_map(options.map, schema);
    context.used.push_back(options.map);
  }
  for (const std::string& file : files) {
    input.tables.push_back(read_table(file, schema, {options.names, map ? &*map : nullptr}));
    const std::vector<std::string>& notices = input.tables.back().notices;
    context.notices.insert(context.notices.end(), notices.begin(), notices.end());
  }
  return input;
}

void store_in_campaign(const BenchInput& input, Result& result, Context& context) {
  if (!input.campaign) return;
  if (std::optional<Warning> replaced = replaces_refined(*input.campaign, result))
    result.warnings.push_back(std::move(*replaced));
  context.outputs.add(input.campaign->parameters, updated_parameters(*input.campaign, result));
}

}  // namespace ident::app
