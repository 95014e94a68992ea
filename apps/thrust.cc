// `ident thrust`: thrust and torque constant of a propeller from bench sweeps.
#include "bench.h"
#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/io/csv/table_schemas.h"

namespace ident::app {
namespace {

struct Options {
  BenchOptions bench;
  double radius = kNaN, rho = kNaN;
};

Outcome run(const Options& options, Context& context) {
  const BenchInput input = bench_input(options.bench, thrust_schema(), "thrust", &Campaign::thrust, context);
  ThrustOptions chosen = input.vehicle ? thrust_options(*input.vehicle) : ThrustOptions{};
  if (options.radius > 0.0) chosen.radius = options.radius;
  if (options.rho > 0.0) chosen.rho = options.rho;
  Result result = estimate_thrust(input.tables, chosen);
  store_in_campaign(input, result, context);
  return result;
}

}  // namespace

Action thrust_command(CLI::App& cli) {
  auto options = std::make_shared<Options>();
  add_bench_options(cli, options->bench,
                    "thrust sweeps (omega or rpm, thrust; torque, delta or u, voltage, current)");
  cli.add_option("--radius", options->radius, "of the propeller in m: adds CT, CQ and the figure of merit")
      ->type_name("M")
      ->check(positive_number());
  cli.add_option("--rho", options->rho,
                 "density of the air in kg/m^3; default that of the vehicle file, else 1.225")
      ->type_name("KG/M3")
      ->check(positive_number());
  examples(cli,
           {{"ident thrust sweep.csv", "kT and kQ with their uncertainty, and how well the law holds"},
            {"ident thrust a.csv b.csv --radius 0.1", "two sweeps together, with CT, CQ, figure of merit"},
            {"ident thrust", "the sweeps of ident.yaml; kT and kQ are stored for the other commands"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
