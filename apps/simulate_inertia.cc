// `ident simulate inertia`: swings of a trifilar pendulum as a table.
#include "ident/sim/simulate_inertia.h"

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "simulate.h"

namespace ident::app {
namespace {

struct Options {
  SimulateOptions file;
  PendulumSwings swings;
};

Outcome run(const Options& options, Context& context) {
  const Vehicle vehicle = read_vehicle(options.file.vehicle);
  return simulated_table("inertia", simulate_inertia(vehicle, options.swings), options.file, vehicle,
                         options.swings.seed, context);
}

}  // namespace

void add_simulate_inertia(CLI::App& cli, const std::shared_ptr<Action>& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = cli.add_subcommand("inertia", "periods of a trifilar pendulum: empty, then about x, y, z");
  add_simulate_options(*sub, o->file);
  PendulumSwings& s = o->swings;
  add_number(*sub, "--seed", s.seed, "of the noise");
  add_number(*sub, "--repeats", s.repeats, "rows of each axis");
  add_number(*sub, "--platform-mass", s.platform_mass, "kg; 0: a third of the vehicle's");
  add_number(*sub, "--radius", s.radius, "of the wires from the axis, m; 0: 1.2 times the farthest hub");
  add_number(*sub, "--length", s.length, "of the wires, m");
  add_number(*sub, "--offset", s.offset, "of the vehicle's centre of gravity from the axis, m");
  add_number(*sub, "--amplitude", s.amplitude, "of the swings, rad; 0: small");
  add_number(*sub, "--noise", s.noise, "of a period, s");
  add_outliers(*sub, s.outliers, "share of rows that are far off");
  examples(*sub,
           {{"ident simulate inertia --vehicle v.yaml --output pendulum.csv", "10 swings of each axis"},
            {"ident simulate inertia --vehicle v.yaml --output pendulum.csv --offset 0.01 --amplitude 0.3",
             "hung off the centre, swung far"}});
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
