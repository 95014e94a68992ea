// Both directions match value, slope and curvature at the nominal hover speed.
#include "ident/io/simulators/thrust_polynomial.h"

#include <cmath>

#include "ident/io/simulators/entries.h"

namespace ident {
namespace {

// Curvature that `offset` gives at hover: 2/(1 + 0.02) of the effect's (x - 1)^2/(x^2 + 0.02).
constexpr double kOffsetCurvature = 2.0 / 1.02;
constexpr double kRounding = 1e-13;  // of the thrust at hover

double cleaned(double part, double whole) {
  return std::abs(part) < kRounding * std::abs(whole) ? 0.0 : part;
}

}  // namespace

double ThrustPolynomial::speed(double T) const {
  if (c == 0.0) return (T - a) / b;
  return (-b + std::sqrt(b * b - 4 * c * (a - T))) / (2 * c);
}

ThrustPolynomial thrust_polynomial(const Vehicle& v) {
  const double Omega = hover_speed(v), T = v.value("kT") * Omega * Omega;
  const double slope = value_or_zero(v, "thrust_curve.c"), offset = value_or_zero(v, "thrust_curve.offset");
  if (slope == 0.0 && offset == 0.0) return {0.0, 0.0, v.value("kT")};
  const double first = T * (2 + slope) / Omega,
               second = T * (2 + 4 * slope + kOffsetCurvature * offset) / (Omega * Omega);
  ThrustPolynomial out{.b = first - second * Omega, .c = second / 2};
  out.b = cleaned(out.b, T / Omega);
  out.a = cleaned(T - out.b * Omega - out.c * Omega * Omega, T);
  return out;
}

bool set_thrust_polynomial(Vehicle& v, const ThrustPolynomial& thrust) {
  const double T = v.value("m") * v.g / static_cast<double>(v.rotors.size()), Omega = thrust.speed(T);
  if (!(Omega > 0) || !std::isfinite(Omega)) return false;
  v.parameters["kT"] = {T / (Omega * Omega), {}};
  if (thrust.a == 0.0 && thrust.b == 0.0) {
    v.parameters["kT"] = {thrust.c, {}};
    return true;
  }
  const double slope = (thrust.b + 2 * thrust.c * Omega) * Omega / T - 2;
  const double offset = (2 * thrust.c * Omega * Omega / T - 2 - 4 * slope) / kOffsetCurvature;
  state_unless_zero(v, "thrust_curve.c", cleaned(slope, 10.0));
  state_unless_zero(v, "thrust_curve.offset", cleaned(offset, 10.0));
  return true;
}

}  // namespace ident
