// `ident flightlog`: a model against flight logs, verified as it is or refined.
#include "flight_input.h"
#include "ident/flight/checks/rotor_speed_jitter.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/flight/verify.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "ident/views/simulation_residuals.h"

namespace ident::app {
namespace {

struct Options {
  FlightOptions flight;
  bool refine = false;
  std::vector<std::string> free;
  int bootstrap = 0;
  double horizon = 1.0;
};

/// A model simulated against the logs, with what is left over.
Result verified(const Vehicle& vehicle, const FlightInput& input, double horizon) {
  Result result = verify_flight(vehicle, input.logs, horizon);
  if (result.has_warning("no_turning")) return result;  // nothing was simulated
  result.sections.push_back(simulation_residuals(result.sections.back()));
  return result;
}

/// Adds to a refinement how the refined model simulates the logs.
void verify_too(Result& refined, const FlightInput& input, double horizon) {
  Vehicle vehicle = input.vehicle;
  for (const Parameter& p : refined.parameters) vehicle.parameters[p.name] = {.value = p.value, .std = p.std};
  vehicle.correlation = refined.correlation;
  std::vector<Section> shown = verified(vehicle, input, horizon).sections;
  std::move(shown.end() - 2, shown.end(), std::back_inserter(refined.sections));
}

Outcome run(const Options& options, Context& context) {
  const Model model = options.refine ? Model::before_these_logs : Model::as_stored;
  FlightInput input = flight_input(options.flight, model, context);
  if (!options.refine) return verified(input.vehicle, input, options.horizon);
  leave_out_unflown(input, context);
  Progress progress("refining");
  RefineOptions refine;
  refine.free = options.free;
  refine.bootstrap = options.bootstrap;
  refine.shown = context.shown;
  refine.progress = [&](double share) { progress.update(share); };
  Result result = refine_flight(input.vehicle, input.logs, refine);
  result.warnings.insert(result.warnings.begin(), input.warnings.begin(), input.warnings.end());
  const bool simulated = !result.has_warning("no_turning");
  if (result.has_warning("speeds_jitter")) input.logs = without_commands(input.logs);
  if (result.has_warning("not_driven")) input.logs = *without_undriven(input.vehicle, input.logs);
  if (refine.shown != Shown::numbers && simulated) verify_too(result, input, options.horizon);
  if (input.campaign) {
    input.history.after = with_result(input.history.before, result);
    context.outputs.add(input.campaign->parameters, vehicle_to_yaml(input.history.after));
    context.outputs.add(flight_history_path(), flight_history_text(input.history));
  }
  return result;
}

}  // namespace

Action flightlog_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  add_flight_options(cli, options->flight);
  cli.add_flag("--refine", options->refine,
               "estimate all parameters together, what is known before as priors");
  cli.add_option("--free", options->free, "further parameters to estimate")
      ->delimiter(',')
      ->type_name("NAME,...");
  cli.add_option("--bootstrap", options->bootstrap,
                 "intervals from that many block bootstraps (50 or more) in place of the sandwich")
      ->check(CLI::Range(50, 100000))
      ->type_name("N");
  cli.add_option("--horizon", options->horizon, "length of the simulated windows, s; default 1")
      ->check(CLI::Range(0.02, 60.0))
      ->type_name("SECONDS");
  examples(
      cli,
      {{"ident flightlog log.csv --vehicle v.yaml", "the model as it is, simulated against the log"},
       {"ident flightlog a.csv b.csv --vehicle v.yaml --refine", "all parameters together from both logs"},
       {"ident flightlog log.csv --map m.yaml --vehicle v.yaml --refine",
        "a log with other names and units"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
