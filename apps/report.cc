// `ident report`: the parameters of a vehicle with their uncertainty.
#include "command.h"
#include "ident/io/vehicle_file.h"
#include "ident/model/parameters.h"

namespace ident::app {
namespace {

Result parameters_of(const Vehicle& vehicle) {
  Result result;
  result.command = "report";
  result.inputs = {vehicle.file};
  result.warnings = vehicle.warnings;
  for (const auto& [name, known] : vehicle.parameters) {
    const double std = known.std.value_or(kNaN);
    Parameter p;
    p.name = name;
    p.value = known.value;
    p.std = std;
    p.ci95 = {known.value - 1.96 * std, known.value + 1.96 * std};
    p.unit = parameter_unit(name);
    p.source = "prior";
    result.parameters.push_back(p);
  }
  return result;
}

}  // namespace

Action report_command(CLI::App& cli) {
  auto file = std::make_shared<std::string>();
  cli.add_option("--vehicle", *file, "vehicle or parameter file")->type_name("FILE")->required();
  examples(cli, {{"ident report --vehicle falcon.yaml", "the parameters as a table"},
                 {"ident report --vehicle falcon.yaml --report falcon.html", "and as a page"}});
  return [file](Context&) -> Outcome { return parameters_of(read_vehicle(*file)); };
}

}  // namespace ident::app
