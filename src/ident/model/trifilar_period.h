// The exact period of a trifilar pendulum at any amplitude.
//
// A body hangs on three wires of length L whose ends lie r from the axis. Turned by theta it has risen:
//
//     h(theta)^2 = L^2 - 4 r^2 sin^2(theta/2)          height of the suspension above the body        (1)
//     V = m g (L - h) ,  2 K = (J + m h'^2) theta'^2 ,  h' = -r^2 sin(theta)/h                         (2)
//
// so that with sin(theta/2) = sin(theta_0/2) sin(phi)
//
//     T = 4 int_0^(pi/2) sqrt( (J + m h'^2) (h + h_0) / (2 m g r^2) ) / cos(theta/2)  dphi             (3)
//
// For small theta_0: T = 2 pi sqrt(J L/(m g r^2)) (1 + theta_0^2 (1/16 - 3 r^2/(16 L^2) + m r^4/(4 J L^2))),
// the usual formula and its first correction. A centre of gravity c off the axis enters as r^2 = R^2 - c^2.
#pragma once

namespace ident {

/// How a body hangs.
struct TrifilarSuspension {
  double mass = 0.0;            ///< all that hangs, kg
  double gravity = 9.81;        ///< m/s^2
  double radius_squared = 0.0;  ///< r^2, m^2
  double length = 0.0;          ///< of the wires, m
  double amplitude = 0.0;       ///< theta_0, rad
};

/// Period, s, and its derivative with respect to J.
struct TrifilarPeriod {
  double period, slope;
};

/// J: inertia of all that hangs about the axis through its centre of gravity, kg m^2, positive.
TrifilarPeriod trifilar_period(const TrifilarSuspension& suspension, double J);

/// The inertia with that period.
double trifilar_inertia(const TrifilarSuspension& suspension, double period);

}  // namespace ident
