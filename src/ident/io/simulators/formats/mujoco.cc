// MuJoCo: a free body with an inertial, and one motor at a site for each rotor.
//
// Forward, left, up. The control is the thrust in N, of first order where the actuator has a filter; the
// site's z axis is the thrust axis, gear = 0 0 1 0 0 -s kQ/kT; fullinertia = xx yy zz xy xz yz. The air has
// no density.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/mjcf/mjcf_model.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

std::string key(std::size_t n, const char* part) { return fmt::format("rotor{}.{}", n + 1, part); }

bool recognises(std::string_view text) { return text.find("<mujoco") != std::string_view::npos; }

std::size_t rotors_of(const Fields& f) {
  std::size_t n = 0;
  while (f.has(key(n, "gear"))) ++n;
  return n;
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  MassProperties body{.m = f.positive("mass"), .c_B = flipped(f.vector3("inertial.pos"))};
  body.J = flipped(mjcf_inertia(f));
  set_mass_properties(v, body);
  if (f.has("gravity")) v.g = std::abs(f.vector3("gravity").z());
  const std::size_t rotors = rotors_of(f);
  double most = 0.0, ratio = 0.0, lag = 0.0;
  for (std::size_t n = 0; n < rotors; ++n) {
    const std::vector<double> gear = f.numbers(key(n, "gear"), 6);
    if (!(gear[2] > 0) || gear[0] != 0 || gear[1] != 0 || gear[3] != 0 || gear[4] != 0)
      f.fail(key(n, "gear"), "is no rotor along the z axis of its site: 0 0 thrust 0 0 torque is read");
    Rotor rotor{.r_B = flipped(f.vector3(key(n, "pos"))),
                .a_B = flipped(mjcf_axis(f, key(n, ""))),
                .s = gear[5] > 0 ? -1 : 1};
    v.rotors.push_back(rotor);
    const double full = gear[2] * f.numbers(key(n, "ctrlrange"), 2)[1];
    if (!(full > 0)) f.fail(key(n, "ctrlrange"), "has to reach above 0");
    const double share = 1.0 / static_cast<double>(rotors);
    most += share * full, ratio += share * std::abs(gear[5] / gear[2]),
        lag += share * f.number(key(n, "dynprm"), 0.0);
  }
  set_by_full_thrust(v, most, most * ratio);
  set_first_order(v, lag, 0.0);
  assume(v, f,
         fmt::format(
             "MuJoCo knows no rotor speed: {} rad/s at full command are assumed, only kT km^2 and kQ km^2 "
             "count; its filter acts on the thrust, the lag here on the speed",
             kAssumedFullSpeed));
  return v;
}

void stand_in(const Vehicle&, Vehicle& v) {
  set_by_full_thrust(v, full_thrust(v), full_thrust(v) * torque_per_thrust(v));
}

std::vector<Value> values(const Vehicle& v, const Fields* own) {
  const MassProperties body = mass_properties(v);
  const Eigen::Matrix3d J = flipped(body.J);
  const Eigen::Vector3d c = flipped(body.c_B);
  std::vector<Value> out = {{"mass", {body.m}, "kg", "m"},
                            {"inertial.pos", {c.x(), c.y(), c.z()}, "m", "centre of gravity"}};
  if (own && own->has("inertial.quat"))
    own->fail("inertial.quat", "turns the inertia: give fullinertia without quat to have it patched");
  const bool diagonal = own && own->has("diaginertia");
  if (diagonal && !J.isDiagonal(0.0))
    own->fail("diaginertia", "cannot hold products of inertia: use fullinertia");
  if (diagonal)
    out.push_back({"diaginertia", {J(0, 0), J(1, 1), J(2, 2)}, "kg m^2", "Jxx, Jyy, Jzz"});
  else
    out.push_back({"fullinertia",
                   {J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2)},
                   "kg m^2",
                   "Jxx, Jyy, Jzz, -Jxy, -Jxz, Jyz"});
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Eigen::Vector3d r = flipped(v.rotors[n].r_B), a = flipped(v.rotors[n].a_B);
    const double up = own && own->has(key(n, "gear")) ? own->numbers(key(n, "gear"), 6)[2] : 1.0;
    const double share = rotor_ratio(v, n);
    out.push_back({key(n, "pos"), {r.x(), r.y(), r.z()}, "m", "hub"});
    if (!own || own->has(key(n, "zaxis")) || !a.isApprox(mjcf_axis(*own, key(n, "")), 1e-12))
      out.push_back({key(n, "zaxis"), {a.x(), a.y(), a.z()}, "-", "thrust axis"});
    out.push_back(
        {key(n, "gear"), {0, 0, up, 0, 0, -v.rotors[n].s * up * torque_per_thrust(v)}, "m", "-s kQ/kT"});
    const double low = own && own->has(key(n, "ctrlrange")) ? own->numbers(key(n, "ctrlrange"), 2)[0] : 0.0;
    out.push_back({key(n, "ctrlrange"), {low, share * full_thrust(v) / up}, "N", "kT (Omega_0 + km)^2"});
    if (!own || own->has(key(n, "dynprm")))
      out.push_back(
          {key(n, "dynprm"), {motor_lags(v).up}, "s", "2 zeta_m/omega_m + dead_time, on the thrust"});
  }
  out.push_back({"gravity", {0, 0, -v.g}, "m/s^2", "gravity"});
  return out;
}

std::string page(const Vehicle& v, const Values& values) {
  std::string sites, motors;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const auto text = [&](const char* part) { return values.text(key(n, part)); };
    sites += fmt::format("      <site name=\"rotor{}\" pos=\"{}\" zaxis=\"{}\"/>\n", n + 1, text("pos"),
                         text("zaxis"));
    const std::string filter = values.number(key(n, "dynprm")) > 0
                                   ? fmt::format("dyntype=\"filter\" dynprm=\"{}\" ", text("dynprm"))
                                   : "";
    motors += fmt::format(
        "    <general name=\"motor{0}\" site=\"rotor{0}\" gear=\"{1}\" ctrllimited=\"true\" "
        "ctrlrange=\"{2}\" "
        "{3}gaintype=\"fixed\" gainprm=\"1\"/>\n",
        n + 1, text("gear"), text("ctrlrange"), filter);
  }
  return fmt::format(
      "<mujoco model=\"{}\">\n  <!-- Written by ident. Forward, left, up. The control of a motor is its "
      "thrust in N.\n"
      "       mass: {}\n       pos: {}\n       fullinertia: {}\n       gear: {}\n       ctrlrange: {}\n      "
      " dynprm: {} -->\n"
      "  <option gravity=\"{}\" density=\"0\" viscosity=\"0\" integrator=\"RK4\" timestep=\"0.002\"/>\n  "
      "<worldbody>\n"
      "    <body name=\"base\" pos=\"0 0 1\">\n      <freejoint/>\n"
      "      <inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>\n{}    </body>\n  </worldbody>\n  "
      "<actuator>\n{}  </actuator>\n"
      "</mujoco>\n",
      v.name.empty() ? "vehicle" : xml_text(v.name), values.note("mass"), values.note("inertial.pos"),
      values.note("fullinertia"), values.note(key(0, "gear")), values.note(key(0, "ctrlrange")),
      values.note(key(0, "dynprm")), values.text("gravity"), values.text("inertial.pos"), values.text("mass"),
      values.text("fullinertia"), sites, motors);
}

std::vector<std::string> remarks(const Vehicle&, const Vehicle&) {
  return {
      "MuJoCo's filter acts on the thrust, the motor's lag on its speed: small steps agree, large ones by "
      "second order"};
}

}  // namespace

SimulatorFormat mujoco_format() {
  return {.target = "mujoco",
          .meaning = "MuJoCo: an MJCF model",
          .holds = {.needs = {"km"}, .rotor_speeds = false},
          .recognises = recognises,
          .read = mjcf_fields,
          .vehicle = vehicle,
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
