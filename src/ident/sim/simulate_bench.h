// Bench data of a vehicle file with known truth: thrust sweeps, motor steps, pendulum swings.
//
//   ThrustSweep options;                        // 15 set-points, 5 rows each, noise of an ordinary stand
//   const NumberTable table = simulate_thrust(vehicle, options);
//   estimate_thrust({table}); compare with the vehicle's kT and kQ
//
// The vehicle's `effect.parameter` entries act as far as a bench sees them (motor_asymmetry, motor_delay,
// battery_sag by its rate, thrust_curve, rotor_mismatch). Noise 0 and no outliers: the table is the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ident/data/table.h"
#include "ident/model/vehicle.h"
#include "ident/sim/bench_noise.h"

namespace ident {

enum class CommandColumn { delta, pulse, none };

/// A stand that goes up through the commands in equal steps, several rows at each.
struct ThrustSweep {
  std::size_t rotor = 0;
  int set_points = 15, repeats = 5, rows_at_rest = 5;
  double lowest = 0.1, highest = 1.0;           ///< command
  double noise = 0.003;                         ///< of thrust and torque, share of their largest value
  double speed_noise = 0.002;                   ///< share of the largest speed
  double tare_thrust = 0.0, tare_torque = 0.0;  ///< readings at rest, N and N m
  BenchDisturbance disturbance;
  CommandColumn command = CommandColumn::delta;
  /// Voltage of the supply, V. The speed then follows from the motor constants ki, kv, R, I0, G at the duty
  /// delta (model/dc_motor.h), not from km; `voltage` and `current` are those of the supply.
  std::optional<double> supply;
  std::uint64_t seed = 1;
};

/// A recording of commands that step from level to level and hold.
struct MotorSteps {
  std::size_t rotor = 0;
  std::vector<double> levels = {0.3, 0.6, 0.4, 0.8, 0.5, 0.7, 0.2};
  double hold = 0.0;     ///< s at each level; 0: long enough to settle
  double rate = 200.0;   ///< rows a second
  double jitter = 0.05;  ///< standard deviation of the rows' times, share of the interval
  double noise = 0.002;  ///< of the speed, share of km
  BenchDisturbance disturbance;
  CommandColumn command = CommandColumn::delta;  ///< delta or pulse
  std::uint64_t seed = 1;
};

/// A trifilar pendulum: the empty platform, then the vehicle with each axis upright.
struct PendulumSwings {
  int repeats = 10;            ///< rows of each axis
  double platform_mass = 0.0;  ///< kg; 0: a third of the vehicle's mass
  double radius = 0.0;         ///< of the wires from the axis, m; 0: 1.2 times the farthest hub
  double length = 1.0;         ///< of the wires, m
  double offset = 0.0;         ///< of the vehicle's centre of gravity from the axis, m
  double amplitude = 0.0;      ///< rad; 0: small swings
  double noise = 2e-3;         ///< of a period, s
  double outliers = 0.0;       ///< share of rows that are 8 to 40 standard deviations off
  std::uint64_t seed = 1;
};

}  // namespace ident
