// `ident inertia`: moments of inertia from a trifilar pendulum, and of a propeller from its measures.
#include "bench.h"
#include "ident/bench/inertia/trifilar_inertia.h"
#include "ident/io/csv/table_schemas.h"

namespace ident::app {
namespace {

struct Options {
  BenchOptions bench;
  std::vector<double> propeller;  ///< mass kg, chord m, length m
};

Outcome run(const Options& options, Context& context) {
  Result result;
  std::optional<BenchInput> input;
  if (!options.bench.files.empty() || options.propeller.empty()) {
    input = bench_input(options.bench, pendulum_schema(), "inertia", &Campaign::inertia, context);
    const double gravity = input->vehicle ? input->vehicle->g : InertiaOptions{}.gravity;
    result = estimate_inertia(input->tables, {.gravity = gravity});
  }
  result.command = "inertia";
  if (!options.propeller.empty()) {
    const auto& [mass, chord, length] =
        std::tuple(options.propeller[0], options.propeller[1], options.propeller[2]);
    result.parameters.push_back(propeller_inertia(mass, chord, length));
  }
  if (input) store_in_campaign(*input, result, context);
  return result;
}

}  // namespace

Action inertia_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  add_bench_options(cli, options->bench, "pendulum files (axis, period, mass, radius, length)");
  cli.add_option("--propeller", options->propeller, "mass kg, chord m, length m of a propeller: adds Jp")
      ->delimiter(',')
      ->expected(3)
      ->type_name("MASS,CHORD,LENGTH");
  examples(cli, {{"ident inertia pendulum.csv", "Jxx, Jyy, Jzz with their uncertainty"},
                 {"ident inertia pendulum.csv --vehicle v.yaml", "with the gravity of the vehicle file"},
                 {"ident inertia --propeller 0.012,0.02,0.25", "Jp of a propeller as a plate"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
