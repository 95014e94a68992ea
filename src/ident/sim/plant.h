// A vehicle that flies: the flight model with the vehicle's effects, driven command by command.
//
// Its equations are those of model/flight.h; the effects complete it (effects/plant.cc), because includes go
// one way.
#pragma once

#include <memory>
#include <span>

#include "ident/model/flight.h"
#include "ident/model/vehicle.h"

namespace ident {

class Plant {
 public:
  /// Throws UsageError where the vehicle lacks what flight needs: rotors, mass, inertia, kT, km, omega_m.
  explicit Plant(const Vehicle& vehicle);
  ~Plant();
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  const Vehicle& vehicle() const;
  /// Value of a constant of the flight model, kg, m, s, rad.
  double constant(param::Index index) const;
  /// Dead time of the command with all effects, s.
  double command_delay() const;
  /// Delay of rates and attitude, s.
  double sensor_delay() const;
  /// Mass with all effects, kg.
  double mass() const;
  /// Centre of gravity from the origin with all effects, m.
  Vec3<double> centre_of_gravity() const;

  /// Rates of change at any state with rotors that turn steadily, rad/s.
  BodyRate<double> steady_rate(const BodyState<double>& state, std::span<const double> Omega) const;

  /// Starts anew at time t, s, with steady rotors and the command that has held for long.
  void start(double t, const BodyState<double>& state, std::span<const double> Omega,
             std::span<const double> delta);
  /// Command from time t on, not before the present.
  void command(double t, std::span<const double> delta);
  /// Puts a history of commands, [rotor][time], in the place of what was commanded so far.
  void recall(const std::vector<double>& t, const std::vector<std::vector<double>>& delta);
  /// Battery voltage over that at which km holds, from the last time given to t linear.
  void voltage(double t, double ratio);
  /// Force, N, and moment about the centre of gravity, N m, from outside, until changed.
  void disturb(const Vec3<double>& F_B, const Vec3<double>& M_B);
  /// Integrates up to time t in equal steps of at most `longest_step` seconds.
  void advance(double t, double longest_step);

  double t() const;
  const FlightState<double>& state() const;
  /// Rates of change at the present state.
  BodyRate<double> rate() const;
  /// What an IMU without noise shows at the present state.
  SensorSeam<double> imu() const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace ident
