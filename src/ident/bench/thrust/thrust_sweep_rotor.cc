// Coefficients and figure of merit.
#include "ident/bench/thrust/thrust_sweep_rotor.h"

#include <cmath>
#include <numbers>

namespace ident {

double disc_area(double radius) { return std::numbers::pi * radius * radius; }

double thrust_coefficient(double kT, double radius, double rho) {
  return kT / (rho * disc_area(radius) * radius * radius);  // (1)
}

double torque_coefficient(double kQ, double radius, double rho) {
  return kQ / (rho * disc_area(radius) * radius * radius * radius);  // (1)
}

double momentum_power(double thrust, double radius, double rho) {
  return thrust * std::sqrt(thrust / (2.0 * rho * disc_area(radius)));  // (2)
}

double figure_of_merit(double kT, double kQ, double radius, double rho) {
  return kT * std::sqrt(kT) / (kQ * std::sqrt(2.0 * rho * disc_area(radius)));  // (3)
}

LeverRange plausible_lever(const std::optional<double>& radius) {
  if (!radius) return {5e-4, 0.5};
  return {0.03 * *radius, 0.6 * *radius};
}

}  // namespace ident
