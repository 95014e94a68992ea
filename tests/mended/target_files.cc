// From a simulator's file, and from the truth, to the numbers of a target's equations.
#include <fmt/format.h>

#include "../withheld/physics.h"
#include "ident/io/simulators/mjcf/mjcf_model.h"
#include "ident/io/simulators/readers/parameter_lines.h"
#include "ident/io/simulators/readers/python_literal.h"
#include "ident/io/simulators/sdf/sdf_fields.h"
#include "io/simulators/equations/gazebo.h"
#include "io/simulators/equations/rotorpy.h"
#include "target_model.h"

namespace mended {

namespace {

using Eigen::Matrix3d;
using ident::Fields;

Vector3d flipped(const Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }
Matrix3d flipped(const Matrix3d& J) {
  const Eigen::DiagonalMatrix<double, 3> turn(1.0, -1.0, -1.0);
  return turn * J * turn;
}

void gazebo_model(const Fields& p, TargetModel& out) {
  // Mass, centre and inertia of all links: the equations put them together; the centre is not among what they
  // return.
  const std::vector<double> base = p.numbers("base.inertial", 6);
  double m = p.number("base.mass");
  Vector3d c = m * Vector3d(base[0], base[1], base[2]);
  for (std::size_t n = 0; n < kRotors; ++n) {
    const std::string key = fmt::format("rotor{}.", n + 1);
    const std::vector<double> pose = p.numbers(key + "pose", 6);
    out.rotors[n].r = {pose[0], pose[1], pose[2]};
    out.rotors[n].a = ident::test::turned_by(pose).col(2);
    m += p.number(key + "mass"), c += p.number(key + "mass") * out.rotors[n].r;
    out.rotors[n].kT = p.number(key + "motorConstant");
    const double turning = p.word(key + "turningDirection", "") == "ccw" ? 1.0 : -1.0;
    out.rotors[n].kQ = -turning * out.rotors[n].kT * p.number(key + "momentConstant");
  }
  out.c = c / m;
  for (TargetRotor& rotor : out.rotors) rotor.r -= out.c;
  out.kd = p.number("rotor1.rotorDragCoefficient");
  out.momentum = p.number("rotor1.izz") / p.number("rotor1.rotorVelocitySlowdownSim");
  out.full = p.number("rotor1.maxRotVelocity");
}

void rotorpy_model(const Fields& p, TargetModel& out) {
  const std::vector<double> turns = p.numbers("rotor_directions", kRotors);
  for (std::size_t n = 0; n < kRotors; ++n) {
    out.rotors[n].r = p.vector3(fmt::format("rotor_pos.r{}", n + 1));
    out.rotors[n].kT = p.number("k_eta"), out.rotors[n].kQ = turns[n] * p.number("k_m");
  }
  out.low = p.number("rotor_speed_min"), out.full = p.number("rotor_speed_max");
  out.kd = p.number("k_d"), out.kz = p.number("k_z"), out.kh = p.number("k_h");
  out.k_flap = p.number("k_flap");
  out.c_D = {p.number("c_Dx"), p.number("c_Dy"), p.number("c_Dz")};
}

void sih_model(const Fields& p, TargetModel& out) {
  out.by_speed = false;
  const double x = p.number("SIH_L_PITCH"), y = p.number("SIH_L_ROLL"), T = p.number("SIH_T_MAX");
  const std::array<Vector3d, kRotors> places = {Vector3d(x, -y, 0), {-x, y, 0}, {x, y, 0}, {-x, -y, 0}};
  for (std::size_t n = 0; n < kRotors; ++n) {
    out.rotors[n].r = places[n], out.rotors[n].kT = T;
    out.rotors[n].kQ = (n < 2 ? -1 : 1) * p.number("SIH_Q_MAX");
  }
  out.linear_drag = p.number("SIH_KDV");
}

void mujoco_model(const Fields& p, TargetModel& out) {
  out.by_speed = false;
  out.c = p.vector3("inertial.pos");
  for (std::size_t n = 0; n < kRotors; ++n) {
    const std::string key = fmt::format("rotor{}.", n + 1);
    const std::vector<double> gear = p.numbers(key + "gear", 6);
    const double full = p.numbers(key + "ctrlrange", 2)[1];
    out.rotors[n].r = p.vector3(key + "pos") - out.c;
    out.rotors[n].a = p.vector3(key + "zaxis").normalized();
    out.rotors[n].kT = full * gear[2], out.rotors[n].kQ = full * gear[5];
  }
}

}  // namespace

ident::Fields fields_of(const std::string& target, const std::string& text, const std::string& file) {
  if (target == "gz") return ident::sdf_fields(text, file, "multicopter-motor-model");
  if (target == "px4-sih") return ident::parameter_lines(text, file);
  if (target == "rotorpy") return ident::python_literal(text, file, "quad_params");
  return ident::mjcf_fields(text, file);
}

ident::test::SimulatorEquations equations_of(const std::string& target, const Fields& fields) {
  if (target == "gz") return ident::test::gazebo_equations(fields, kRotors);
  if (target == "px4-sih") return ident::test::sih_equations(fields);
  if (target == "rotorpy") return ident::test::rotorpy_equations(fields);
  // The test's motors are thrusts in N up to ctrlrange; those here go to 1.
  ident::test::SimulatorEquations e = ident::test::mujoco_equations(fields, kRotors);
  const auto in_newton = [&fields](std::vector<double> motors) {
    for (std::size_t n = 0; n < kRotors; ++n)
      motors[n] *= fields.numbers(fmt::format("rotor{}.ctrlrange", n + 1), 2)[1];
    return motors;
  };
  e.target = [](double delta, std::size_t) { return delta * delta; };
  e.wrench = [in_newton, inner = e.wrench](const ident::test::SimulatorState& s,
                                           const std::vector<double>& dot) {
    ident::test::SimulatorState there = s;
    there.motors = in_newton(s.motors);
    return inner(there, in_newton(dot));
  };
  return e;
}

TargetModel model_of(const std::string& target, const Fields& fields) {
  TargetModel out;
  out.target = target;
  if (target == "gz") gazebo_model(fields, out);
  if (target == "px4-sih") sih_model(fields, out);
  if (target == "rotorpy") rotorpy_model(fields, out);
  if (target == "mujoco") mujoco_model(fields, out);
  const ident::test::SimulatorEquations e = equations_of(target, fields);
  out.m = e.m, out.g = e.g, out.J = e.J, out.J_inverse = e.J.inverse();
  out.tau_up = e.tau_up, out.tau_down = e.tau_down;
  return out;
}

TargetModel reduced_truth(const std::string& target, const withheld::Vehicle& v, const withheld::Effects& e,
                          const TargetModel& stated) {
  TargetModel out = stated;
  const bool gz = target == "gz", rotorpy = target == "rotorpy", sih = target == "px4-sih",
             mujoco = target == "mujoco";
  const withheld::Body body(v, e);
  out.m = body.m, out.J = flipped(body.J), out.J_inverse = out.J.inverse();
  out.c = sih ? Vector3d(Vector3d::Zero()) : flipped(body.c);
  const double delay = e.command_delay, lag = 2 * v.zeta_m / v.omega_m;
  out.tau_up = lag + delay;
  out.tau_down = (gz ? lag / (1 - e.slow_spin_down) : lag) + delay;
  out.low = 0, out.full = out.by_speed ? v.km : 1;
  const double unit = out.by_speed ? 1 : v.km * v.km;
  const double mean_share = 1 - e.weakness.mean();
  for (std::size_t n = 0; n < kRotors; ++n) {
    const auto i = static_cast<Eigen::Index>(n);
    const withheld::Rotor& rotor = v.rotors[n];
    TargetRotor& to = out.rotors[n];
    const double share = gz || mujoco ? 1 - e.weakness[i] : mean_share;
    to.kT = share * v.kT * unit;
    to.kQ = -rotor.s * share * v.kQ * unit;
    if (sih) continue;  // places and axes are as stated
    const Vector3d turn(e.tilt(0, i), e.tilt(1, i), 0);
    Vector3d a = rotor.a;
    if (turn.norm() > 0) a = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * a;
    to.a = rotorpy ? Vector3d(Vector3d::UnitZ()) : flipped(a);
    to.r = flipped(rotor.r) - out.c;
  }
  if (gz || rotorpy) out.kd = e.drag + e.flap_tilt;
  if (gz) out.momentum = std::max(e.Jp, stated.momentum);
  if (rotorpy) {
    const double disc = 0.5 * v.air_density * M_PI * v.radius * v.radius;
    out.kz = 0.5 * e.inflow, out.kh = e.lift_gain * disc, out.k_flap = -e.flap_moment;
    out.c_D = e.body_drag * Vector3d(1, 1, e.body_drag_z);
  }
  if (sih) out.linear_drag = 4 * (e.drag + e.flap_tilt) * v.hover_speed() + e.body_drag * 3;
  return out;
}

}  // namespace mended
