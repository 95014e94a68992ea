// `ident simulate inertia`: swings of a trifilar pendulum as a table.
#include "ident/io/vehicle_file.h"
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
  const auto number = [&](const char* flag, auto& value, const char* what) {
    sub->add_option(flag, value, what)->capture_default_str();
  };
  number("--seed", s.seed, "of the noise");
  number("--repeats", s.repeats, "rows of each axis");
  number("--platform-mass", s.platform_mass, "kg; 0: a third of the vehicle's");
  number("--radius", s.radius, "of the wires from the axis, m; 0: 1.2 times the farthest hub");
  number("--length", s.length, "of the wires, m");
  number("--offset", s.offset, "of the vehicle's centre of gravity from the axis, m");
  number("--amplitude", s.amplitude, "of the swings, rad; 0: small");
  number("--noise", s.noise, "of a period, s");
  sub->add_option("--outliers", s.outliers, "share of rows that are far off")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  examples(*sub,
           {{"ident simulate inertia --vehicle v.yaml --output pendulum.csv", "10 swings of each axis"},
            {"ident simulate inertia --vehicle v.yaml --output pendulum.csv --offset 0.01 --amplitude 0.3",
             "hung off the centre, swung far"}});
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
