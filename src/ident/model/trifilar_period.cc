// Quadrature of the exact period; the midpoint rule converges exponentially for this periodic integrand.
#include "ident/model/trifilar_period.h"

#include <cmath>

namespace ident {

TrifilarPeriod trifilar_period(const TrifilarSuspension& suspension, double J) {
  const auto [m, g, r2, L, theta_0] = suspension;
  const int points = theta_0 == 0.0 ? 1 : 24;  // 24: to rounding for amplitudes up to 2 rad
  const double s_0 = std::sin(0.5 * theta_0);
  const double h_0 = std::sqrt(L * L - 4.0 * r2 * s_0 * s_0);
  TrifilarPeriod T{0.0, 0.0};
  for (int i = 0; i < points; ++i) {
    const double phi = M_PI_2 * (i + 0.5) / points;
    const double s = s_0 * std::sin(phi), s2 = s * s, c2 = 1.0 - s2;  // of theta/2
    const double h2 = L * L - 4.0 * r2 * s2;                          // (1)
    const double J_all = J + m * 4.0 * r2 * r2 * s2 * c2 / h2;        // (2)
    const double root = std::sqrt(J_all * (std::sqrt(h2) + h_0) / (2.0 * m * g * r2) / c2);
    T.period += root;  // (3)
    T.slope += 0.5 * root / J_all;
  }
  const double weight = 4.0 * M_PI_2 / points;
  return {weight * T.period, weight * T.slope};
}

double trifilar_inertia(const TrifilarSuspension& suspension, double period) {
  const auto [m, g, r2, L, theta_0] = suspension;
  double J = m * g * r2 * period * period / (4.0 * M_PI * M_PI * L);
  for (int i = 0; i < 50 && theta_0 != 0.0; ++i) {
    const TrifilarPeriod T = trifilar_period(suspension, J);
    const double next = J + (period - T.period) / T.slope;  // concave in J: Newton's steps are safe
    const bool settled = std::fabs(next - J) <= 1e-15 * J;
    J = next > 0.0 ? next : 0.5 * J;
    if (settled) break;
  }
  return J;
}

}  // namespace ident
