// Rows of a step recording: the motor model between commands that hold.
#include "ident/sim/simulate_motor.h"

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/sim/stand.h"

namespace ident {
namespace {

void check(const Vehicle& vehicle, const MotorSteps& options) {
  if (options.levels.size() < 2) throw UsageError("steps need at least two levels of the command");
  for (const double level : options.levels)
    if (!(level >= 0.0 && level <= 1.0)) throw UsageError("levels of the command lie between 0 and 1");
  if (!(options.rate >= 10.0 && options.rate <= 1e5))
    throw UsageError("rate: between 10 and 100000 rows a second");
  if (!(options.hold >= 0.0)) throw UsageError("hold: not below 0 s");
  if (options.command == CommandColumn::none) throw UsageError("a step recording needs its command");
  if (options.command == CommandColumn::pulse && !vehicle.command)
    throw UsageError("pulse widths need 'command' in the vehicle file, the range that they span");
}

/// Until the slower pole has settled to a few parts in a thousand, and not below 0.4 s.
double settling_time(const Stand& stand, const Vehicle& vehicle) {
  const double zeta = std::max(vehicle.value("zeta_m"), 0.2);
  const double slow = zeta > 1.0 ? 1.0 / (zeta + std::sqrt(zeta * zeta - 1.0)) : zeta;
  return std::max(0.4, 6.0 / (slow * stand.needed("omega_m")) + vehicle.value("dead_time"));
}

std::vector<double> row_times(const MotorSteps& options, double hold, Random& random) {
  const auto rows =
      static_cast<std::size_t>(hold * static_cast<double>(options.levels.size()) * options.rate);
  std::vector<double> times;
  for (std::size_t i = 0; i < rows; ++i) {
    const double early = i == 0 ? 0.0 : std::clamp(options.jitter * random.normal(), -0.3, 0.3);
    times.push_back((static_cast<double>(i) + early) / options.rate);
  }
  return times;
}

}  // namespace

NumberTable simulate_motor(const Vehicle& vehicle, const MotorSteps& options) {
  check(vehicle, options);
  Stand stand(vehicle, options.rotor);
  const double km = stand.needed("km"),
               hold = options.hold > 0.0 ? options.hold : settling_time(stand, vehicle);
  Random random(options.seed);
  BenchSensor speed(options.noise * km, options.disturbance, random);
  const bool pulse = options.command == CommandColumn::pulse;
  NumberTable table{.file = "steps.csv"};
  std::vector<double> t = row_times(options, hold, random), command, omega;
  double level = options.levels.front();
  stand.start(0.0, level);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto step = std::min(static_cast<std::size_t>(t[i] / hold), options.levels.size() - 1);
    stand.advance(t[i]);
    omega.push_back(speed(stand.Omega()));
    if (options.levels[step] != level) stand.command(t[i], level = options.levels[step]);
    command.push_back(pulse ? vehicle.command->min_us +
                                  level * (vehicle.command->max_us - vehicle.command->min_us)
                            : level);
    table.line.push_back(static_cast<long>(i) + 2);
  }
  table.columns = {{"t", "t", std::move(t)},
                   {pulse ? "u" : "delta", pulse ? "u" : "delta", std::move(command)},
                   {"omega", "omega", std::move(omega)}};
  return table;
}

}  // namespace ident
