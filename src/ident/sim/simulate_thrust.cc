// Rows of a thrust sweep: rest, then set-points from the lowest command to the highest.
#include "ident/sim/simulate_thrust.h"

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/model/dc_motor.h"
#include "ident/sim/stand.h"

namespace ident {
namespace {

void check(const Vehicle& vehicle, const ThrustSweep& options) {
  if (options.set_points < 2 || options.repeats < 1 || options.rows_at_rest < 0)
    throw UsageError("a sweep needs at least 2 set-points with 1 row each");
  if (!(options.lowest >= 0.0) || !(options.highest > options.lowest) || options.highest > 1.0)
    throw UsageError("commands of a sweep rise from the lowest to the highest, both between 0 and 1");
  if (options.command == CommandColumn::pulse && !vehicle.command)
    throw UsageError("pulse widths need 'command' in the vehicle file, the range that they span");
}

/// What the sensors would show without noise.
struct Reading {
  double delta = 0.0, Omega = 0.0, T = 0.0, Q = 0.0, current = 0.0;
};

class Sweep {
 public:
  Sweep(const Vehicle& vehicle, const ThrustSweep& options)
      : stand_(vehicle, options.rotor), options_(options), has_torque_(vehicle.value("kQ") > 0.0) {
    stand_.needed("kT");
    if (!options.supply) {
      stand_.needed("km");
      return;
    }
    kQ_ = stand_.needed("kQ");
    motor_ = {stand_.needed("ki"), stand_.needed("kv"), stand_.needed("R"),
              vehicle.has("I0") ? vehicle.value("I0") : 0.0, vehicle.has("G") ? vehicle.value("G") : 1.0};
  }
  bool has_torque() const { return has_torque_; }

  Reading at_rest() const { return {}; }

  Reading at(double delta) const {
    Reading r{.delta = delta};
    if (options_.supply) {
      const double V = delta * *options_.supply;
      r.Omega = motor_.steady_speed(V, kQ_);
      r.current = delta * motor_.current(V, r.Omega);  // the supply's side: V I_supply = delta V I
    } else {
      r.Omega = stand_.steady_speed(delta);
    }
    const Stand::Load load = stand_.load(r.Omega);
    r.T = load.T, r.Q = load.Q;
    return r;
  }

 private:
  Stand stand_;
  ThrustSweep options_;
  bool has_torque_;
  double kQ_ = 0.0;
  DcMotor motor_;
};

std::vector<Reading> readings(const Sweep& sweep, const ThrustSweep& options) {
  std::vector<Reading> rows(static_cast<std::size_t>(options.rows_at_rest), sweep.at_rest());
  for (int s = 0; s < options.set_points; ++s) {
    const double share = s / (options.set_points - 1.0);
    rows.insert(rows.end(), static_cast<std::size_t>(options.repeats),
                sweep.at(options.lowest + share * (options.highest - options.lowest)));
  }
  return rows;
}

}  // namespace

NumberTable simulate_thrust(const Vehicle& vehicle, const ThrustSweep& options) {
  check(vehicle, options);
  const Sweep sweep(vehicle, options);
  const Reading full = sweep.at(options.highest);
  Random random(options.seed);
  const auto sensor = [&](double std) { return BenchSensor(std, options.disturbance, random); };
  BenchSensor thrust = sensor(options.noise * full.T), torque = sensor(options.noise * full.Q),
              speed = sensor(options.speed_noise * full.Omega);
  // Electrical sensors of a stand: half a percent of the current, a tenth of a percent of the voltage.
  BenchSensor current = sensor(options.noise > 0.0 ? 0.005 * full.current : 0.0),
              voltage = sensor(options.noise > 0.0 ? 0.001 * options.supply.value_or(0.0) : 0.0);
  std::vector<double> omega, T, Q, command, V, I;
  NumberTable table{.file = "sweep.csv"};
  for (const Reading& row : readings(sweep, options)) {
    const double shown = speed(row.Omega);
    omega.push_back(row.Omega > 0.0 ? shown : 0.0);  // a rotor that stands is seen to stand
    T.push_back(thrust(row.T) + options.tare_thrust);
    Q.push_back(torque(row.Q) + options.tare_torque);
    V.push_back(voltage(options.supply.value_or(0.0)));
    I.push_back(current(row.current));
    command.push_back(options.command == CommandColumn::pulse
                          ? vehicle.command->min_us +
                                row.delta * (vehicle.command->max_us - vehicle.command->min_us)
                          : row.delta);
    table.line.push_back(static_cast<long>(omega.size()) + 1);
  }
  const auto add = [&](const char* name, std::vector<double>& values) {
    table.columns.push_back({name, name, std::move(values)});
  };
  add("omega", omega), add("thrust", T);
  if (sweep.has_torque()) add("torque", Q);
  if (options.command != CommandColumn::none)
    add(options.command == CommandColumn::pulse ? "u" : "delta", command);
  if (options.supply) add("voltage", V), add("current", I);
  return table;
}

}  // namespace ident
