// Pegasus (Isaac Sim): the thrust curve and drag of a multirotor's configuration, as Python.
//
// T = rotor_constant w^2; rolling_moment_coefficient is kQ, unlike Gazebo's; rot_dir is the yaw moment, z up.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr double kDragSpeed = 5.0;  // m/s at which the drag of the airframe is replaced by a linear one

void stand_in(const Vehicle& whole, Vehicle& v) {
  const double drag = as_stated(whole_linear_drag(whole, kDragSpeed));
  for (const char* name : {"Kdx", "Kdy", "Kdz"}) {
    v.parameters.erase(name);
    state_unless_zero(v, name, drag);
  }
}

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const std::size_t n = v.rotors.size();
  std::vector<double> thrust, torque, turns;
  for (std::size_t k = 0; k < n; ++k) {
    thrust.push_back(rotor_ratio(v, k) * v.value("kT")), torque.push_back(rotor_ratio(v, k) * v.value("kQ"));
    turns.push_back(-v.rotors[k].s);
  }
  return {{"num_rotors", {static_cast<double>(n)}, "-", "rotors"},
          {"rotor_constant", thrust, "N/(rad/s)^2", "kT"},
          {"rolling_moment_coefficient", torque, "N m/(rad/s)^2", "kQ"},
          {"rot_dir", turns, "-", "yaw moment on the body, 1 counter-clockwise"},
          {"min_rotor_velocity", std::vector<double>(n, value_or_zero(v, "Omega_0")), "rad/s", "Omega_0"},
          {"max_rotor_velocity", std::vector<double>(n, full_speed(v)), "rad/s", "Omega_0 + km"},
          {"drag", std::vector<double>(3, value_or_zero(v, "Kdx")), "N/(m/s)", "all drag as a linear one"}};
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out = fmt::format(
      "# Pegasus thrust curve and drag of {}, written by ident.\n# The USD model holds the masses: mass {} "
      "kg, "
      "inertia {} {} {} kg m^2, products {} {} {} (forward, left, up).\n",
      values.source, v.value("m"), v.value("Jxx"), v.value("Jyy"), v.value("Jzz"), -value_or_zero(v, "Jxy"),
      -value_or_zero(v, "Jxz"), value_or_zero(v, "Jyz"));
  for (std::size_t n = 0; n < v.rotors.size(); ++n)
    out += fmt::format("# rotor{} at {} {} {} m\n", n, v.rotors[n].r_B.x(), -v.rotors[n].r_B.y(),
                       -v.rotors[n].r_B.z());
  out +=
      "from pegasus.simulator.logic.dynamics import LinearDrag\nfrom pegasus.simulator.logic.thrusters "
      "import "
      "QuadraticThrustCurve\n\nthrust_curve = QuadraticThrustCurve({\n";
  for (const Value& value : values.all()) {
    if (value.name == "drag") continue;
    const std::string text = values.text(value.name, ", ");
    out += fmt::format("    \"{}\": {},  # {}\n", value.name,
                       value.numbers.size() > 1 ? "[" + text + "]" : text, values.note(value.name));
  }
  return out +
         fmt::format("}})\ndrag = LinearDrag([{}])  # {}\n", values.text("drag", ", "), values.note("drag"));
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle& v) {
  std::vector<std::string> out = {
      "mass, inertia and hubs belong into the USD model: they are in the comments"};
  if (whole_linear_drag(whole, kDragSpeed) > 0)
    out.push_back(fmt::format(
        "all drag becomes a linear one of {:.4g} N/(m/s): that of the rotors as at hover, that of the "
        "airframe as at {} m/s",
        value_or_zero(v, "Kdx"), kDragSpeed));
  return out;
}

}  // namespace

SimulatorFormat pegasus_format() {
  return {.target = "pegasus",
          .meaning = "Pegasus (Isaac Sim): thrust curve and drag, in Python",
          .holds = {.tilted_axes = false,
                    .each_rotor = true,
                    .motor = Capacity::Motor::instant,
                    .idle_speed = true,
                    .constants = {"Kdx", "Kdy", "Kdz"},
                    .replaced = {"rotor_drag.kd", "parasitic_drag.C"},
                    .needs = {"km"}},
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
