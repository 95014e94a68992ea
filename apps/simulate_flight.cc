// `ident simulate flight`: a closed-loop flight as a log.
#include <fmt/format.h>

#include <cmath>

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/sim/scenario.h"
#include "ident/sim/simulate.h"
#include "simulate.h"

namespace ident::app {
namespace {

struct Options {
  SimulateOptions file;
  std::string noise = "typical";
  std::vector<std::string> without;
  bool log_step = false;
  double attitude_rate = 0, position_rate = 0, rotor_rate = 0;  // Hz; 0: every row
  SimulationOptions flight;
};

std::string scenario_list() {
  std::string text = "Scenarios:";
  for (const ScenarioInfo& info : scenarios()) text += fmt::format("\n  {:<10}{}", info.name, info.meaning);
  return text;
}

int every(double rate, double wanted) {
  return wanted > 0 ? std::max(1, static_cast<int>(std::lround(rate / wanted))) : 1;
}

LoggedSignals logged(const Options& options) {
  LoggedSignals signals;
  signals.attitude = every(options.flight.rate, options.attitude_rate);
  signals.position = signals.velocity = every(options.flight.rate, options.position_rate);
  signals.rotor_speeds = every(options.flight.rate, options.rotor_rate);
  for (const std::string& word : options.without) {
    if (word == "rates") signals.rates = 0;
    if (word == "force") signals.force = 0;
    if (word == "attitude") signals.attitude = 0;
    if (word == "position") signals.position = 0;
    if (word == "velocity") signals.velocity = 0;
    if (word == "rotors") signals.rotor_speeds = 0;
    if (word == "battery") signals.battery = 0;
    if (word == "commands") signals.commands = false;
  }
  return signals;
}

Result description(const Options& options, const Vehicle& vehicle, const SimulatedFlight& flight) {
  Result result = simulated(options.file, vehicle, options.flight.seed);
  result.extra["scenario"] = options.flight.scenario;
  result.extra["noise"] = options.noise;
  result.extra["rows"] = flight.log.rows();
  result.extra["duration"] = flight.log.t.back();
  result.extra["lowest"] = flight.lowest;
  result.extra["furthest_from_plan"] = flight.furthest;
  result.extra["gyro_bias"] = {flight.gyro_bias[0], flight.gyro_bias[1], flight.gyro_bias[2]};
  result.verdict = fmt::format("{} rows over {:.4g} s in {}, seed {}.", flight.log.rows(),
                               flight.log.t.back(), options.file.output, options.flight.seed);
  return result;
}

Outcome run(Options options, Context& context) {
  const Vehicle vehicle = read_vehicle(options.file.vehicle);
  options.flight.noise = noise_level(options.noise);
  options.flight.signals = logged(options);
  if (options.log_step) options.flight.longest_step = 0.0;
  Progress progress("flying");
  options.flight.progress = [&](double share) { progress.update(share); };
  const SimulatedFlight flight = simulate_flight(vehicle, options.flight);
  std::vector<std::string> comments =
      provenance("simulate flight", options.file.vehicle, options.flight.seed);
  comments.push_back(fmt::format("scenario {}, noise {}, turbulence {} m/s, {} Hz", options.flight.scenario,
                                 options.noise, options.flight.turbulence, options.flight.rate));
  context.outputs.add(options.file.output,
                      flight_log_to_csv(flight.log, vehicle, digits(options.file), comments));
  return description(options, vehicle, flight);
}

}  // namespace

void add_simulate_flight(CLI::App& cli, const std::shared_ptr<Action>& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = cli.add_subcommand("flight", "a closed-loop flight with a realistic sensor model");
  add_simulate_options(*sub, o->file);
  std::vector<std::string> names;
  for (const ScenarioInfo& info : scenarios()) names.push_back(info.name);
  sub->add_option("--scenario", o->flight.scenario, "what is flown: one of the scenarios above")
      ->capture_default_str();
  sub->add_option("--duration", o->flight.duration, "s")->capture_default_str();
  sub->add_option("--rate", o->flight.rate, "rows and commands a second")->capture_default_str();
  sub->add_option("--seed", o->flight.seed, "of noise, gusts and phases")->capture_default_str();
  sub->add_option("--noise", o->noise, "none, low, typical, high")->capture_default_str();
  sub->add_option("--turbulence", o->flight.turbulence, "gusts, standard deviation in m/s")
      ->capture_default_str();
  sub->add_option("--battery-used", o->flight.battery_used,
                  "share of its voltage that the battery loses (needs battery_voltage in the vehicle file)")
      ->capture_default_str();
  sub->add_option(
         "--without", o->without,
         "signals to leave out: rates, force, attitude, position, velocity, rotors, battery, commands")
      ->delimiter(',')
      ->check(CLI::IsMember(
          {"rates", "force", "attitude", "position", "velocity", "rotors", "battery", "commands"}));
  sub->add_option("--attitude-rate", o->attitude_rate, "Hz; each row if not given");
  sub->add_option("--position-rate", o->position_rate, "of position and velocity, Hz; each row if not given");
  sub->add_option("--rotor-rate", o->rotor_rate, "of rotor speeds, Hz; each row if not given");
  CLI::Option* step = sub->add_option("--step", o->flight.longest_step, "longest step of the integrator, s");
  step->capture_default_str();
  sub->add_flag("--log-step", o->log_step,
                "steps as an estimator makes them, from row to row where rows are close")
      ->excludes(step);
  examples(*sub,
           {{"ident simulate flight --vehicle v.yaml --output flight.csv", "a minute of all manoeuvres"},
            {"ident simulate flight --vehicle v.yaml --output eight.csv --scenario eight --seed 7 "
             "--turbulence 0.3",
             "figure eights in gusts"}});
  sub->footer(sub->get_footer() + "\n\n" + scenario_list());
  sub->callback([o, chosen] { *chosen = [o](Context& context) { return run(*o, context); }; });
}

}  // namespace ident::app
