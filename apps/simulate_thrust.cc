// `ident simulate thrust`: a thrust sweep as a table.
#include "ident/sim/simulate_thrust.h"

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "simulate.h"

namespace ident::app {
namespace {

struct Options {
  SimulateOptions file;
  ThrustSweep sweep;
  int rotor = 1;
  double supply = kNaN;
};

Outcome run(Options options, Context& context) {
  const Vehicle vehicle = read_vehicle(options.file.vehicle);
  options.sweep.rotor = static_cast<std::size_t>(options.rotor - 1);
  if (options.supply > 0.0) options.sweep.supply = options.supply;
  return simulated_table("thrust", simulate_thrust(vehicle, options.sweep), options.file, vehicle,
                         options.sweep.seed, context);
}

}  // namespace

void add_simulate_thrust(CLI::App& cli, const std::shared_ptr<Action>& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = cli.add_subcommand("thrust", "a sweep on a thrust stand, several rows at each set-point");
  add_simulate_options(*sub, o->file);
  ThrustSweep& s = o->sweep;
  add_number(*sub, "--seed", s.seed, "of the noise");
  add_rotor(*sub, o->rotor);
  add_number(*sub, "--set-points", s.set_points, "from the lowest to the highest command");
  add_number(*sub, "--repeats", s.repeats, "rows at each set-point");
  add_number(*sub, "--at-rest", s.rows_at_rest, "rows before the first");
  add_number(*sub, "--lowest", s.lowest, "command of the first set-point");
  add_number(*sub, "--highest", s.highest, "command of the last set-point");
  add_number(*sub, "--noise", s.noise, "of thrust and torque, share of their largest value");
  add_number(*sub, "--speed-noise", s.speed_noise, "share of the largest speed");
  add_number(*sub, "--tare-thrust", s.tare_thrust, "reading at rest, N");
  add_number(*sub, "--tare-torque", s.tare_torque, "reading at rest, N m");
  add_recording_options(*sub, s.disturbance, s.command, "column: delta, u (pulse width in us) or none");
  sub->add_option("--supply", o->supply,
                  "its voltage: adds voltage and current; speeds then follow from ki, kv, R, I0, not from km")
      ->check(positive_number())
      ->type_name("VOLT");
  examples(
      *sub,
      {{"ident simulate thrust --vehicle v.yaml --output sweep.csv --seed 7", "a sweep of 15 set-points"},
       {"ident simulate thrust --vehicle v.yaml --output sweep.csv --tare-thrust 0.2 --outliers 0.01",
        "with an offset at rest and a reading in a hundred far off"}});
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
