// A propeller's constants without their size, and how well it turns power into thrust.
//
//   CT = kT/(rho A r^2) ,  CQ = kQ/(rho A r^3) ,  A = pi r^2              [Phang 10, 11]    (1)
//   P = T^1.5/sqrt(2 rho A)                                 momentum theory at hover        (2)
//   figure of merit = P/(Q Omega) = kT^1.5/(kQ sqrt(2 rho A))                               (3)
#pragma once

#include <optional>

namespace ident {

double disc_area(double radius);
double thrust_coefficient(double kT, double radius, double rho);
double torque_coefficient(double kQ, double radius, double rho);
/// Least power for a thrust, W.
double momentum_power(double thrust, double radius, double rho);
double figure_of_merit(double kT, double kQ, double radius, double rho);

/// Range of kQ/kT, m, that a propeller can have: 0.09 to 0.24 radii on the propellers of the UIUC data base,
/// 0.26 on a 23 mm one; without a radius that of propellers from 15 mm to 1 m.
struct LeverRange {
  double low, high;
};
LeverRange plausible_lever(const std::optional<double>& radius);

}  // namespace ident
