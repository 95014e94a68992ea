// Slung load on an elastic cable, sloshing mass, flexible arms, unbalanced blades, downwash in bursts.
#include "outside.h"

#include <cmath>

namespace withheld {

using Eigen::Vector3d;

namespace {
constexpr double kCableRate = 2 * M_PI * 9, kCableDamping = 0.25;  // of the load on its elastic cable
constexpr double kSloshDamping = 0.04, kArmDamping = 0.05;
const Vector3d kHook(0, 0, 0.01);  // m

Vector3d cable_pull(const Vehicle& v, const Effects& e, const Motion& motion, const Vector3d& p,
                    const Vector3d& u) {
  const Vector3d hook = motion.p + motion.q * kHook;
  const Vector3d hook_v = motion.v + motion.q * motion.w.cross(kHook);
  const Vector3d line = p - hook;
  const double length = line.norm();
  const Vector3d n = line / length;
  const double slack = e.slung_length - e.slung_mass * v.gravity / (e.slung_mass * kCableRate * kCableRate);
  const double pull = e.slung_mass * (kCableRate * kCableRate * (length - slack) +
                                      2 * kCableDamping * kCableRate * n.dot(u - hook_v));
  return std::max(pull, 0.0) * n;
}
}  // namespace

Bursts::Bursts(const Vehicle& v, double duration, Random random) {
  const int count = random.integer(2, 4);
  for (int i = 0; i < count; ++i) {
    const double from = duration * (i + random.uniform(0.1, 0.8)) / count;
    const Vector3d F(random.normal(0, 0.15), random.normal(0, 0.15), 1);
    const Vector3d M =
        v.arm * Vector3d(random.normal(0, 0.08), random.normal(0, 0.08), random.normal(0, 0.01));
    bursts_.push_back({from, random.uniform(0.8, 2.5), v.m * F, v.m * M});
  }
}

Wrench Bursts::at(double t, double buffet) const {
  Wrench sum;
  for (const Burst& burst : bursts_) {
    const double x = (t - burst.from) / burst.length;
    if (x <= 0 || x >= 1) continue;
    const double size = std::pow(std::sin(M_PI * x), 2) * (1 + 0.5 * buffet);
    sum.F += size * burst.F;
    sum.M += size * burst.M;
  }
  return sum;
}

Aux settled_aux(const Vehicle& v, const Effects& e, const Motion& motion) {
  Aux aux = Aux::Zero();
  if (e.slung_mass > 0) aux.head<3>() = motion.p + motion.q * kHook + Vector3d(0, 0, e.slung_length);
  if (e.arm_flex > 0) aux.head<4>().setConstant(v.m * v.gravity / kRotors);
  return aux;
}

Four transmitted_thrust(const Effects& e, const Four& thrust, const Aux& aux, Aux* slope) {
  const Four passed = aux.head<4>(), rate = aux.segment<4>(4);
  slope->head<4>() = rate;
  slope->segment<4>(4) = e.arm_rate * e.arm_rate * (thrust - passed) - 2 * kArmDamping * e.arm_rate * rate;
  return thrust + e.arm_flex * (passed - thrust);
}

Memory remember(const Vehicle& v, const Effects& e, const Motion& motion, const Four& Omega,
                const Wrench& others, const Aux& aux) {
  Memory result{{}, Aux::Zero()};
  if (e.slung_mass > 0) {
    const Vector3d p = aux.head<3>(), u = aux.segment<3>(3);
    const Vector3d pull = cable_pull(v, e, motion, p, u);
    result.slope.head<3>() = u;
    result.slope.segment<3>(3) = Vector3d(0, 0, v.gravity) - pull / e.slung_mass;
    // The stated mass holds the load too; the airframe alone is lighter. Scaled to that mass:
    const double rest = 1 - e.slung_mass / v.m;
    const Vector3d F = motion.q.conjugate() * pull;
    result.wrench.F = (others.F + F) / rest - others.F;
    result.wrench.M = kHook.cross(F);
  }
  if (e.slosh_share > 0) {
    const Eigen::Vector2d s = aux.head<2>(), u = aux.segment<2>(2);
    const Eigen::Vector2d spring = e.slosh_rate * e.slosh_rate * s + 2 * kSloshDamping * e.slosh_rate * u;
    const double m_s = e.slosh_share * v.m;
    const Eigen::Vector2d F = (others.F.head<2>() + m_s * spring) / (1 - e.slosh_share);
    result.slope.head<2>() = u;
    result.slope.segment<2>(2) = -spring - F / v.m;
    result.wrench.F.head<2>() = F - others.F.head<2>();
    result.wrench.M = Vector3d(0, 0, 0.3 * v.arm).cross(Vector3d(m_s * spring.x(), m_s * spring.y(), 0));
  }
  if (e.imbalance > 0) {
    const double phase = aux[0];
    const Vector3d F = e.imbalance * Omega[0] * Omega[0] * Vector3d(std::cos(phase), std::sin(phase), 0);
    result.slope[0] = Omega[0];
    result.wrench.F = F;
    result.wrench.M = v.rotors[0].r.cross(F);
  }
  return result;
}

}  // namespace withheld
