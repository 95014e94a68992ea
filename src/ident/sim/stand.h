// One rotor of a vehicle on a bench: its motor, its thrust and its drag torque, with the vehicle's effects.
//
// The equations are those of model/flight.h; the effects complete it (effects/stand.cc), because includes go
// one way.
#pragma once

#include <memory>

#include "ident/model/vehicle.h"

namespace ident {

class Stand {
 public:
  /// `rotor` from 0. Mass and inertia of the vehicle do not matter here and may be missing.
  explicit Stand(const Vehicle& vehicle, std::size_t rotor = 0);
  ~Stand();
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  /// Value of a constant that this test needs; throws UsageError where the vehicle does not state it or it
  /// is not positive.
  double needed(const char* name) const;

  /// Thrust, N, and drag torque, N m, of the rotor at a steady speed in still air far from the ground.
  struct Load {
    double T = 0.0, Q = 0.0;
  };
  Load load(double Omega) const;

  /// The motor anew at time t, s, with a command that has held for long.
  void start(double t, double delta);
  /// Command from time t on, not before the present.
  void command(double t, double delta);
  /// The motor at a later time.
  void advance(double t);
  double Omega() const;

  /// Speed that the motor holds for a command, rad/s.
  double steady_speed(double delta) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace ident
