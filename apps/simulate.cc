// `ident simulate`: flights and bench data of any vehicle file, with known truth.
#include "simulate.h"

#include <fmt/format.h>

#include <map>

#include "ident/effects/all_parameters.h"
#include "ident/model/parameters.h"

namespace ident::app {

void add_simulate_options(CLI::App& cli, SimulateOptions& options) {
  cli.fallthrough();
  cli.add_option("--vehicle", options.vehicle, "vehicle file; effects under its parameters act")
      ->type_name("FILE")
      ->required();
  cli.add_option("--output", options.output, "file to write, CSV")
      ->type_name("FILE")
      ->required()
      ->each(require_folder_of);
  cli.add_option("--precision", options.digits, "plain, or full: numbers that read back exactly")
      ->check(CLI::IsMember({"plain", "full"}))
      ->capture_default_str();
}

CsvDigits digits(const SimulateOptions& options) {
  return options.digits == "full" ? CsvDigits::full : CsvDigits::plain;
}

void add_outliers(CLI::App& cli, double& share, const char* what) {
  cli.add_option("--outliers", share, what)->check(CLI::Range(0.0, 0.5))->capture_default_str();
}

void add_rotor(CLI::App& cli, int& rotor) {
  cli.add_option("--rotor", rotor, "its number")->check(CLI::Range(1, 8))->capture_default_str();
}

void add_recording_options(CLI::App& cli, BenchDisturbance& disturbance, CommandColumn& command,
                           const char* columns) {
  static const std::map<std::string, CommandColumn> words = {
      {"delta", CommandColumn::delta}, {"u", CommandColumn::pulse}, {"none", CommandColumn::none}};
  add_outliers(cli, disturbance.outliers, "share of readings that are far off");
  cli.add_option("--autocorrelation", disturbance.autocorrelation, "of the noise from row to row")
      ->check(CLI::Range(-0.99, 0.99))
      ->capture_default_str();
  cli.add_option("--command", command, columns)
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD")
      ->default_str("delta");
}

std::vector<std::string> provenance(const std::string& what, const std::string& vehicle, std::uint64_t seed) {
  return {fmt::format("ident {} of {}, seed {}", what, vehicle, seed)};
}

Result simulated(const SimulateOptions& options, const Vehicle& vehicle, std::uint64_t seed) {
  Result result;
  result.command = "simulate";
  result.inputs = {options.vehicle};
  result.seed = seed;
  for (const auto& [name, known] : vehicle.parameters) {
    Parameter p;
    p.name = name, p.value = known.value, p.unit = parameter_unit(name), p.source = "truth";
    result.parameters.push_back(p);
  }
  result.extra["output"] = options.output;
  result.extra["seed"] = seed;
  return result;
}

Result simulated_table(const std::string& kind, const NumberTable& table, const SimulateOptions& options,
                       const Vehicle& vehicle, std::uint64_t seed, Context& context) {
  context.outputs.add(options.output, table_to_csv(table, digits(options),
                                                   provenance("simulate " + kind, options.vehicle, seed)));
  Result result = simulated(options, vehicle, seed);
  result.extra["rows"] = table.rows();
  result.verdict = fmt::format("{} rows in {}, seed {}.", table.rows(), options.output, seed);
  return result;
}

Action simulate_command(CLI::App& cli) {
  auto chosen = std::make_shared<Action>();
  cli.require_subcommand(1);
  add_simulate_flight(cli, chosen);
  add_simulate_thrust(cli, chosen);
  add_simulate_motor(cli, chosen);
  add_simulate_inertia(cli, chosen);
  examples(cli,
           {{"ident simulate flight --vehicle falcon.yaml --output flight.csv", "a mixed flight of 60 s"},
            {"ident simulate thrust --vehicle falcon.yaml --output sweep.csv", "a thrust sweep"},
            {"ident simulate motor --vehicle falcon.yaml --output steps.csv", "steps of the command"},
            {"ident simulate inertia --vehicle falcon.yaml --output pendulum.csv", "pendulum swings"}});
  return [chosen](Context& context) { return (*chosen)(context); };
}

}  // namespace ident::app
