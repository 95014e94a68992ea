// The equations of RotorPy's Multirotor, from rotorpy/vehicles/multirotor.py (2499cab): compute_body_wrench,
// _s_dot_fn.
#pragma once

#include <fmt/format.h>

#include "ident/io/simulators/fields.h"
#include "support/manoeuvre.h"

namespace ident::test {

inline SimulatorEquations rotorpy_equations(const Fields& p) {
  SimulatorEquations e{.m = p.number("mass"), .g = 9.81};
  e.J << p.number("Ixx"), p.number("Ixy"), p.number("Ixz"), p.number("Ixy"), p.number("Iyy"), p.number("Iyz"),
      p.number("Ixz"), p.number("Iyz"), p.number("Izz");
  const std::size_t n = static_cast<std::size_t>(p.number("num_rotors"));
  e.tau_up = e.tau_down = p.number("tau_m");
  const double low = p.number("rotor_speed_min"), high = p.number("rotor_speed_max");
  e.target = [=](double delta, std::size_t) { return std::clamp(low + (high - low) * delta, low, high); };
  e.wrench = [=](const SimulatorState& s, const std::vector<double>&) {
    using Eigen::Vector3d;
    const Vector3d up = Vector3d::UnitZ(), airspeed = s.q.toRotationMatrix().transpose() * s.v;
    const Vector3d c_D(p.number("c_Dx"), p.number("c_Dy"), p.number("c_Dz")),
        k(p.number("k_d"), p.number("k_d"), p.number("k_z"));
    SimulatorWrench out{-airspeed.norm() * c_D.cwiseProduct(airspeed), Vector3d::Zero()};
    const std::vector<double> turns = p.numbers("rotor_directions", n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3d r = p.vector3(fmt::format("rotor_pos.r{}", i + 1)), local = airspeed + s.w.cross(r);
      const double speed = s.motors[i];
      const Vector3d T = (p.number("k_eta") * speed * speed +
                          p.number("k_h") * (local.x() * local.x() + local.y() * local.y())) *
                         up;
      const Vector3d H = -speed * k.cwiseProduct(local);
      out.F += T + H;
      out.M += r.cross(T + H) + turns[i] * p.number("k_m") * speed * speed * up -
               p.number("k_flap") * speed * local.cross(up);
    }
    return out;
  };
  return e;
}

}  // namespace ident::test
