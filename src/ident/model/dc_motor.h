// The DC motor from first principles, with gear and no-load current: what a voltage makes of a rotor.
//
//   V = R I + kv G Omega                 the motor turns G times faster than the rotor                 (1)
//   Qm = ki (I - I0)                     torque constant and no-load current                           (2)
//   Jp Omega' = G Qm - kQ Omega^2        [Phang 20, 21], [Selby]                                       (3)
//
// Departure from [Phang 20, 21], which conserve power for G = 1 only (erratum 4): the back-EMF is kv G Omega.
// With ki = kv then V I = R I^2 + G Qm Omega + ki I0 G Omega, in which nothing is lost twice.
#pragma once

#include <cmath>

namespace ident {

struct DcMotor {
  double ki = 0.0;  ///< N m/A
  double kv = 0.0;  ///< V s/rad of the motor's own speed
  double R = 0.0;   ///< Ohm
  double I0 = 0.0;  ///< A
  double G = 1.0;   ///< gear: turns of the motor for one of the rotor

  /// (1), A, with the motor at voltage V, V, and the rotor at Omega, rad/s.
  double current(double V, double Omega) const { return (V - kv * G * Omega) / R; }

  /// G Qm of (2), N m: on the rotor's shaft.
  double shaft_torque(double I) const { return G * ki * (I - I0); }

  /// (3) times Jp, N m: what is left to speed the rotor up.
  double surplus_torque(double V, double Omega, double kQ) const {
    return shaft_torque(current(V, Omega)) - kQ * Omega * Omega;
  }

  /// Root of (3) at rest: rotor speed at which the motor holds, rad/s; 0 where it does not overcome I0.
  double steady_speed(double V, double kQ) const {
    const double push = V - R * I0;  // kQ R/(G ki) Omega^2 + kv G Omega = V - R I0
    if (push <= 0.0) return 0.0;
    const double a = kQ * R / (G * ki), b = kv * G;
    return 2.0 * push / (b + std::sqrt(b * b + 4.0 * a * push));
  }
};

}  // namespace ident
