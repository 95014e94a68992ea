// The true forces and moments, with momentum theory solved at each rotor instead of linear coefficients.
#include "physics.h"

#include <cmath>

namespace withheld {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Matrix3d spread(double m, const Vector3d& d) {
  return m * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
}

// Induced speed relative to hover, in level flight at x = v/v_h: y^4 + x^2 y^2 = 1 (Glauert).
double induced_in_forward_flight(double x) {
  const double x2 = x * x;
  return std::sqrt(0.5 * (std::sqrt(x2 * x2 + 4) - x2));
}

// Thrust gained over the ground: a source in each disc and its image below the ground, for rotors at the
// corners of a square with side d (two neighbours, one opposite).
double image_sources(double z, double radius, double d) {
  const double R2 = radius * radius;
  const double own = R2 / (16 * z * z);
  const double beside = R2 * z / std::pow(d * d + 4 * z * z, 1.5);
  const double across = 0.5 * R2 * z / std::pow(2 * d * d + 4 * z * z, 1.5);
  return own + beside + across;
}

double ground_gain(const Vehicle& v, const Effects& e, const Motion& motion, const Vector3d& hub,
                   double v_perp, double v_h) {
  const double height = -(motion.p + motion.q * hub).z();
  const double z = std::max(height, 0.6 * v.radius);
  const double blown_away = 1 / (1 + v_perp * v_perp / (4 * v_h * v_h));
  const double share = e.ground * image_sources(z, v.radius, v.arm * std::sqrt(2.0)) * blown_away;
  return 1 / (1 - std::min(share, 0.5));
}

// Thrust lost where the vehicle sinks into its own wake, worst at a descent with the induced speed.
double vortex_ring_loss(const Effects& e, double climb, double v_perp, double v_h, double noise) {
  const double x = (-climb / v_h - 1) / 0.35, y = v_perp / v_h;
  return e.vortex_ring * std::exp(-x * x - y * y) * (1 + 0.6 * noise);
}

}  // namespace

Body::Body(const Vehicle& v, const Effects& e) {
  m = v.m + e.payload;
  c = (v.m * e.cg + e.payload * e.payload_at) / m;
  J = v.J.asDiagonal();
  J(0, 1) = J(1, 0) = e.products.x();
  J(0, 2) = J(2, 0) = e.products.y();
  J(1, 2) = J(2, 1) = e.products.z();
  J += spread(v.m, e.cg - c) + spread(e.payload, e.payload_at - c);
  J_inverse = J.inverse();
}

Wrench rotor_wrench(const Vehicle& v, const Effects& e, const Motion& motion, const Air& air,
                    const Four& Omega, const Four& dOmega, Four* thrust, const Four* transmitted) {
  Wrench sum;
  const Vector3d v_air = motion.q.conjugate() * (motion.v - e.wind - air.gust);
  const double disc = 2 * v.air_density * M_PI * v.radius * v.radius;
  for (int i = 0; i < kRotors; ++i) {
    const Rotor& rotor = v.rotors[static_cast<std::size_t>(i)];
    const double speed = Omega[i], share = 1 - e.weakness[i];
    Vector3d a = rotor.a;
    if (e.tilt(0, i) != 0 || e.tilt(1, i) != 0) {
      const Vector3d turn(e.tilt(0, i), e.tilt(1, i), 0);
      a = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * a;
    }
    const Vector3d flow = v_air + motion.w.cross(rotor.r);
    const double climb = flow.dot(a);
    const Vector3d across = flow - climb * a;
    const double v_perp = across.norm();

    double T = share * v.kT * speed * speed;
    if (e.thrust_power != 0) T *= std::pow(std::max(speed, 1.0) / v.hover_speed(), e.thrust_power);
    const double v_h = std::sqrt(std::max(T, 1e-9) / disc) + 1e-9;
    const bool blown = e.lift_gain != 0 || e.drag_follows_inflow;
    const double still = blown ? induced_in_forward_flight(v_perp / v_h) : 1;
    if (e.lift_gain != 0) T *= 1 + e.lift_gain * (1 - still);
    if (e.inflow != 0)
      T -= e.inflow * speed * (0.5 * climb + std::sqrt(0.25 * climb * climb + v_h * v_h) - v_h);
    if (e.ground != 0) T *= ground_gain(v, e, motion, rotor.r, v_perp, v_h);
    if (e.vortex_ring != 0) T *= 1 - vortex_ring_loss(e, climb, v_perp, v_h, air.vortex_noise);
    if (thrust) (*thrust)[i] = T;
    if (transmitted) T = (*transmitted)[i];

    // Two thirds of a blade's drag go with its speed alone, one third with the inflow through the disc.
    const double inflow_ratio = e.drag_follows_inflow ? (2 + still) / 3 : 1.0;
    Vector3d F = T * a - (e.drag * inflow_ratio + e.flap_tilt) * speed * across;
    Vector3d M = -rotor.s * share * v.kQ * speed * speed * a;
    M += e.flap_moment * speed * flow.cross(a);
    M -= rotor.s * e.Jp * (dOmega[i] * a + speed * motion.w.cross(a));
    sum.F += F;
    sum.M += rotor.r.cross(F) + M;
  }
  return sum;
}

Wrench body_wrench(const Vehicle& v, const Effects& e, const Motion& motion, const Air& air) {
  Wrench sum;
  const Vector3d gust = motion.q.conjugate() * air.gust;
  sum.F = v.m * e.gust_grip * gust;
  sum.M = Vector3d(0, 0, -e.gust_arm).cross(sum.F);
  if (e.body_drag != 0) {
    const Vector3d v_air = motion.q.conjugate() * (motion.v - e.wind) - gust;
    sum.F -= e.body_drag * v_air.norm() * Vector3d(v_air.x(), v_air.y(), e.body_drag_z * v_air.z());
  }
  return sum;
}

Acceleration accelerate(const Body& body, const Wrench& wrench, const Vector3d& w) {
  const Vector3d M_c = wrench.M - body.c.cross(wrench.F);
  const Vector3d dw = body.J_inverse * (M_c - w.cross(body.J * w));
  return {wrench.F / body.m - dw.cross(body.c) - w.cross(w.cross(body.c)), dw};
}

}  // namespace withheld
