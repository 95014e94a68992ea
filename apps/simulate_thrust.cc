// `ident simulate thrust`: a thrust sweep as a table.
#include "ident/io/vehicle_file.h"
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
  const auto number = [&](const char* flag, auto& value, const char* what) {
    sub->add_option(flag, value, what)->capture_default_str();
  };
  number("--seed", s.seed, "of the noise");
  sub->add_option("--rotor", o->rotor, "its number")->check(CLI::Range(1, 8))->capture_default_str();
  number("--set-points", s.set_points, "from the lowest to the highest command");
  number("--repeats", s.repeats, "rows at each set-point");
  number("--at-rest", s.rows_at_rest, "rows before the first");
  number("--lowest", s.lowest, "command of the first set-point");
  number("--highest", s.highest, "command of the last set-point");
  number("--noise", s.noise, "of thrust and torque, share of their largest value");
  number("--speed-noise", s.speed_noise, "share of the largest speed");
  number("--tare-thrust", s.tare_thrust, "reading at rest, N");
  number("--tare-torque", s.tare_torque, "reading at rest, N m");
  sub->add_option("--outliers", s.disturbance.outliers, "share of readings that are far off")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  sub->add_option("--autocorrelation", s.disturbance.autocorrelation, "of the noise from row to row")
      ->check(CLI::Range(-0.99, 0.99))
      ->capture_default_str();
  sub->add_option("--command", s.command, "column: delta, u (pulse width in us) or none")
      ->transform(CLI::CheckedTransformer(command_columns()).description(""))
      ->type_name("WORD")
      ->default_str("delta");
  sub->add_option("--supply", o->supply,
                  "its voltage: adds voltage and current; speeds then follow from ki, kv, R, I0, not from km")
      ->check(CLI::PositiveNumber)
      ->type_name("VOLT");
  examples(
      *sub,
      {{"ident simulate thrust --vehicle v.yaml --output sweep.csv --seed 7", "a sweep of 15 set-points"},
       {"ident simulate thrust --vehicle v.yaml --output sweep.csv --tare-thrust 0.2 --outliers 0.01",
        "with an offset at rest and a reading in a hundred far off"}});
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
