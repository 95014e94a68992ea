// Solves the inflow of momentum theory and sums up the loads.
#include "rotor.h"

#include <algorithm>
#include <cmath>

namespace field {

double rotor_thrust(const Vehicle& v, const Effects& e, double Omega, double v_perp, double v_climb) {
  const double at_rest = v.kT * Omega * Omega;
  if (e.blade_slope <= 0 || (!e.axial && !e.translational) || Omega < 1) return at_rest;
  const double across = e.translational ? v_perp : 0;
  const double climb = e.axial ? v_climb : 0;
  const double disc = 2 * kAirDensity * v.disc();
  const double nu = Omega * std::sqrt(v.kT / disc);
  // Momentum theory has no solution near the vortex ring; there the inflow of -0.7 v_h is kept.
  const double c = std::max(climb, -0.7 * nu);
  double low = 0, high = 3 * nu + std::abs(c);
  for (int i = 0; i < 30; ++i) {  // (1) falls with v_i, (2) rises
    const double inflow = 0.5 * (low + high);
    const double blade = at_rest + e.blade_slope * Omega * (nu - inflow - c);                          // (1)
    const double momentum = disc * inflow * std::sqrt(across * across + (inflow + c) * (inflow + c));  // (2)
    (blade > momentum ? low : high) = inflow;
  }
  return at_rest + e.blade_slope * Omega * (nu - 0.5 * (low + high) - climb);  // (1)
}

double effective_kz(const Vehicle& v, const Effects& e) {
  const double Omega = v.hover_speed(), h = 0.05 * v.hover_inflow();
  return -(rotor_thrust(v, e, Omega, 0, h) - rotor_thrust(v, e, Omega, 0, -h)) / (2 * h * Omega);
}

RotorLoad rotor_load(const Vehicle& v, const Effects& e, int index, double Omega, const RotorFlow& flow) {
  const Vector3d across(flow.v_B.x(), flow.v_B.y(), 0);
  const double v_perp = across.norm();
  RotorLoad load;
  load.T = rotor_thrust(v, e, Omega, v_perp, -flow.v_B.z());
  if (e.ground_radius > 0) {
    const double ratio = e.ground_radius / (4 * std::max(flow.height, 0.6 * e.ground_radius));
    const double blown_away = std::exp(-v_perp / (2 * v.hover_inflow()));
    load.T *= 1 + (1 / (1 - ratio * ratio) - 1) * blown_away;  // Cheeseman and Bennett
  }
  load.T *= 1 + flow.fluctuation;
  load.Q = v.kQ * Omega * Omega;
  const double tip = std::max(Omega * v.radius, 1.0);
  load.across_B = -e.kd * Omega * across - load.T * e.tilt * across / tip;
  // Nose up in forward flight: +y for +x, -x for +y.
  load.hub_B = e.kf * Omega * flow.v_B.cross(Vector3d(0, 0, -1));
  if (index == e.weak_rotor) {
    load.T *= e.weak_ratio;
    load.Q *= e.weak_ratio;
  }
  return load;
}

}  // namespace field
