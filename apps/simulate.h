// The kinds of data that `ident simulate` makes, one subcommand each.
#pragma once

#include "command.h"
#include "ident/data/table.h"
#include "ident/io/csv/write_csv.h"
#include "ident/sim/simulate_bench.h"

namespace ident::app {

/// Declare `simulate flight`, `thrust`, `motor`, `inertia`; `chosen` is set to what was asked for.
void add_simulate_flight(CLI::App& cli, const std::shared_ptr<Action>& chosen);
void add_simulate_thrust(CLI::App& cli, const std::shared_ptr<Action>& chosen);
void add_simulate_motor(CLI::App& cli, const std::shared_ptr<Action>& chosen);
void add_simulate_inertia(CLI::App& cli, const std::shared_ptr<Action>& chosen);

/// What all of them are told.
struct SimulateOptions {
  std::string vehicle, output, digits = "plain";
};

/// Adds `--vehicle`, `--output` and `--precision`.
void add_simulate_options(CLI::App& cli, SimulateOptions& options);
CsvDigits digits(const SimulateOptions& options);

/// An option of its own for one number.
template <class Number>
void add_number(CLI::App& cli, const char* flag, Number& value, const char* what) {
  cli.add_option(flag, value, what)->capture_default_str();
}
void add_outliers(CLI::App& cli, double& share, const char* what);
/// `--rotor`, counted from 1.
void add_rotor(CLI::App& cli, int& rotor);
/// `--outliers`, `--autocorrelation` and `--command`, whose words `columns` names.
void add_recording_options(CLI::App& cli, BenchDisturbance& disturbance, CommandColumn& command,
                           const char* columns);

/// The sentence at the top of a simulated file: command and seed.
std::vector<std::string> provenance(const std::string& what, const std::string& vehicle, std::uint64_t seed);

/// What is known of a simulated file: the vehicle's constants as truth, the file, the seed.
Result simulated(const SimulateOptions& options, const Vehicle& vehicle, std::uint64_t seed);

/// Writes a bench table (`kind`: thrust, motor, inertia) and describes it.
Result simulated_table(const std::string& kind, const NumberTable& table, const SimulateOptions& options,
                       const Vehicle& vehicle, std::uint64_t seed, Context& context);

}  // namespace ident::app
