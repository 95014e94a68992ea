// `ident motor`: motor constants from recordings of command steps.
#include "bench.h"
#include "ident/bench/motor/motor_step.h"
#include "ident/io/csv/table_schemas.h"

namespace ident::app {
namespace {

Outcome run(const BenchOptions& options, Context& context) {
  const BenchInput input = bench_input(options, motor_schema(), "motor", &Campaign::motor, context);
  const Progress progress("fitting the motor");
  Result result =
      estimate_motor(input.tables, {.command = input.vehicle ? input.vehicle->command : std::nullopt});
  store_in_campaign(input, result, context);
  return result;
}

}  // namespace

Action motor_command(CLI::App& cli) {
  auto options = std::make_shared<BenchOptions>();
  add_bench_options(cli, *options, "step recordings (t, delta or u, omega or rpm)");
  examples(cli, {{"ident motor steps.csv", "km, omega_m, zeta_m, dead time and the step response"},
                 {"ident motor up.csv down.csv --report motor.html",
                  "several recordings of one motor, with plots"},
                 {"ident motor steps.csv --vehicle v.yaml", "with the pulse widths of the vehicle file"}});
  return [options](Context& context) { return run(*options, context); };
}

}  // namespace ident::app
