// `ident gap`: where the simulator differs from the flight, which cause explains it, and how far the gap
// closes.
#include "flight_input.h"
#include "ident/gap/diagnose.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {
namespace {

struct Options {
  FlightOptions flight;
  std::vector<std::string> exclude;
  std::string write_params;
};

Outcome run(const Options& options, Context& context) {
  FlightInput input = flight_input(options.flight, Model::before_these_logs, context);
  leave_out_unflown(input, context);
  Progress progress("diagnosing");
  GapOptions gap;
  gap.exclude = options.exclude;
  gap.shown = context.shown;
  gap.progress = [&](double share, const std::string& tried) { progress.update(share, tried); };
  const Diagnosis diagnosis = diagnose_gap(input.vehicle, input.logs, gap);
  if (!options.write_params.empty())
    context.outputs.add(options.write_params, vehicle_to_yaml(diagnosis.adopted));
  return diagnosis.result;
}

}  // namespace

Action gap_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  add_flight_options(cli, options->flight);
  cli.add_option("--exclude", options->exclude, "causes that must not be tried, as rotor_drag,parameter:km")
      ->delimiter(',')
      ->type_name("EFFECT,...");
  cli.add_option("--write-params", options->write_params, "the vehicle with the causes found, as a file")
      ->type_name("FILE");
  examples(cli, {{"ident gap a.csv b.csv --vehicle v.yaml", "what the model of v.yaml lacks"},
                 {"ident gap a.csv --vehicle v.yaml --write-params better.yaml", "and the model with it"},
                 {"ident gap b.csv --vehicle better.yaml", "whether anything is left"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
