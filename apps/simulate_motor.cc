// `ident simulate motor`: a recording of command steps as a table.
#include "ident/sim/simulate_motor.h"

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "simulate.h"

namespace ident::app {
namespace {

struct Options {
  SimulateOptions file;
  MotorSteps steps;
  int rotor = 1;
};

Outcome run(Options options, Context& context) {
  const Vehicle vehicle = read_vehicle(options.file.vehicle);
  options.steps.rotor = static_cast<std::size_t>(options.rotor - 1);
  return simulated_table("motor", simulate_motor(vehicle, options.steps), options.file, vehicle,
                         options.steps.seed, context);
}

}  // namespace

void add_simulate_motor(CLI::App& cli, const std::shared_ptr<Action>& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = cli.add_subcommand("motor", "steps of the command up and down, and the speed of the rotor");
  add_simulate_options(*sub, o->file);
  MotorSteps& s = o->steps;
  add_number(*sub, "--seed", s.seed, "of noise and jitter");
  add_rotor(*sub, o->rotor);
  sub->add_option("--levels", s.levels, "commands, one after the other")
      ->delimiter(',')
      ->capture_default_str();
  add_number(*sub, "--hold", s.hold, "time at each level, s; 0: until it has settled");
  add_number(*sub, "--rate", s.rate, "rows a second");
  sub->add_option("--jitter", s.jitter, "of the rows' times, share of the interval")
      ->check(CLI::Range(0.0, 0.3))
      ->capture_default_str();
  add_number(*sub, "--noise", s.noise, "of the speed, share of km");
  add_recording_options(*sub, s.disturbance, s.command, "column: delta or u (pulse width in us)");
  examples(*sub, {{"ident simulate motor --vehicle v.yaml --output steps.csv", "seven levels, six steps"},
                  {"ident simulate motor --vehicle v.yaml --output steps.csv --levels 0.3,0.7 --rate 1000",
                   "one step, sampled finely"}});
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
