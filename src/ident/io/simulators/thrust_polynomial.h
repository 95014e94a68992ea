// Thrust as a polynomial of rotor speed, as several simulators have it, against kT and the effect
// thrust_curve.
//
//   T = a + b Omega + c Omega^2, equal to the thrust curve in value, slope and curvature at hover
#pragma once

#include "ident/model/vehicle.h"

namespace ident {

/// Coefficients of rising powers of the rotor speed, rad/s.
struct ThrustPolynomial {
  double a = 0.0, b = 0.0, c = 0.0;

  double at(double Omega) const { return a + Omega * (b + c * Omega); }
  /// Speed at which the thrust is T, the larger one; NaN where there is none.
  double speed(double T) const;
};

ThrustPolynomial thrust_polynomial(const Vehicle& vehicle);

/// States kT and, where a or b is not zero, thrust_curve.c and .offset; m, g and the rotors have to be known.
/// False where such a rotor cannot hover.
bool set_thrust_polynomial(Vehicle& vehicle, const ThrustPolynomial& thrust);

}  // namespace ident
