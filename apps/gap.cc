// `ident gap`: where the simulator differs from the flight, which cause explains it, and how far the gap
// closes.
#include <fmt/format.h>

#include "flight_input.h"
#include "ident/core/error.h"
#include "ident/gap/comparison/compare.h"
#include "ident/gap/diagnose.h"
#include "ident/gap/fix/fix_view.h"
#include "ident/gap/fix/identified_vehicle.h"
#include "ident/gap/fix/vaguely_stated.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {
namespace {

struct Options {
  FlightOptions flight;
  std::vector<std::string> exclude, simulated, simulated_maps;
  std::string write_params, fix;
};

// The diagnosis stands where the file cannot hold what was found.
void write_fix(Diagnosis& diagnosis, const Options& options, const FlightInput& input, Context& context) {
  try {
    const FixedFile fixed = fixed_file(options.flight.vehicle, input.vehicle,
                                       identified_vehicle(input.vehicle, diagnosis), input.logs);
    enter_fix(diagnosis, fixed, options.flight.vehicle, options.fix);
    context.notices.insert(context.notices.end(), fixed.notes.begin(), fixed.notes.end());
    context.outputs.add(options.fix, fixed.text);
  } catch (const InputError& error) {
    diagnosis.result.warn("not_fixed", fmt::format("{} is not written: {}", options.fix, error.what()));
  }
}

FlightInput flown_input(const FlightOptions& flight, Context& context) {
  FlightInput input = flight_input(flight, Model::before_these_logs, context);
  leave_out_unflown(input, context);
  return input;
}

void refuse_without_sense(const Options& options) {
  if (!options.fix.empty() && options.flight.vehicle.empty())
    throw UsageError("--fix needs --vehicle FILE: the file whose values are to be put right");
  if (!options.simulated_maps.empty() && options.simulated.empty())
    throw UsageError("--simulated-map is for the logs of --simulated: there are none");
  if (!options.simulated.empty() && !(options.fix.empty() && options.write_params.empty()))
    throw UsageError("--simulated compares two vehicles: --fix and --write-params are for the logs of one");
}

Outcome run(const Options& options, Context& context) {
  refuse_without_sense(options);
  FlightInput input = flown_input(options.flight, context);
  if (!options.fix.empty()) input.vehicle = vaguely_stated(std::move(input.vehicle));
  std::vector<FlightLog> simulated;
  if (!options.simulated.empty()) {
    FlightOptions other = options.flight;
    other.files = options.simulated, other.maps = options.simulated_maps;
    other.motions.clear(), other.motion_maps.clear();
    simulated = flown_input(other, context).logs;
  }
  Progress progress("diagnosing");
  GapOptions gap;
  gap.exclude = options.exclude;
  gap.shown = context.shown;
  gap.progress = [&](double share, const std::string& tried) { progress.update(share, tried); };
  if (!simulated.empty()) return compare_flights(input.vehicle, input.logs, simulated, gap);
  Diagnosis diagnosis = diagnose_gap(input.vehicle, input.logs, gap);
  if (!options.write_params.empty())
    context.outputs.add(options.write_params, vehicle_to_yaml(diagnosis.adopted));
  if (!options.fix.empty()) write_fix(diagnosis, options, input, context);
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
      ->type_name("FILE")
      ->each(require_folder_of);
  cli.add_option("--fix", options->fix,
                 "the file of --vehicle, a simulator's too, with the values that were identified")
      ->type_name("FILE")
      ->each(require_folder_of);
  cli.add_option("--simulated", options->simulated,
                 "logs of a simulator, flown by its own commands: what differs from the real ones")
      ->type_name("LOG");
  cli.add_option("--simulated-map", options->simulated_maps, "as --map, for the logs of --simulated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  examples(cli, {{"ident gap a.csv b.csv --vehicle v.yaml", "what the model of v.yaml lacks"},
                 {"ident gap a.csv --vehicle v.yaml --write-params better.yaml", "and the model with it"},
                 {"ident gap b.csv --vehicle better.yaml", "whether anything is left"},
                 {"ident gap a.csv --vehicle model.sdf --fix better.sdf", "your simulator's file put right"},
                 {"ident gap real.csv --vehicle v.yaml --simulated sim.csv",
                  "a real flight and a simulated one"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
