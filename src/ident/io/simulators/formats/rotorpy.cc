// RotorPy: the dictionary `quad_params`, as Python, YAML or JSON [rotorpy/vehicles/multirotor.py].
//
// Body frame forward, left, up. T = k_eta w^2, yaw k_m w^2, H = -w diag(k_d, k_d, k_z) v and lift k_h v^2 at
// each hub, drag -|v| diag(c_D) v at the centre, flapping -k_flap w (v x z), which lowers the nose in forward
// flight where ours raises it; speeds of first order.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/readers/python_literal.h"
#include "ident/io/simulators/readers/yaml_fields.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

using Eigen::Vector3d;
constexpr double kGravityRotorpy = 9.81;  // m/s^2 of RotorPy
constexpr const char* kName = "quad_params";

struct Entry {
  const char *name, *constant, *unit;
};
// In RotorPy's frame products with z or y change their sign; those are written below.
constexpr Entry kPlain[] = {{"mass", "m", "kg"},
                            {"Ixx", "Jxx", "kg m^2"},
                            {"Iyy", "Jyy", "kg m^2"},
                            {"Izz", "Jzz", "kg m^2"},
                            {"k_eta", "kT", "N/(rad/s)^2"},
                            {"k_m", "kQ", "N m/(rad/s)^2"},
                            {"k_d", "rotor_drag.kd", "kg/rad"},
                            {"k_z", "axial_inflow.kz", "kg/rad"},
                            {"k_h", "translational_lift.kh", "kg/m"}};

bool recognises(std::string_view text) {
  return assigns_dictionary(text, kName) || yaml_has_keys(text, {"k_eta", "k_m", "rotor_pos"}, kName);
}

Fields read(const std::string& text, const std::string& file) {
  return assigns_dictionary(text, kName) ? python_literal(text, file, kName) : yaml_fields(text, file, kName);
}

std::string hub(std::size_t n) { return fmt::format("rotor_pos.r{}", n + 1); }

void read_rotors(const Fields& f, Vehicle& v) {
  const double count = f.number("num_rotors");
  if (count < 1 || count > 8 || count != std::floor(count)) f.fail("num_rotors", "has to be 1 to 8");
  const std::size_t rotors = static_cast<std::size_t>(count);
  const std::vector<double> turns = f.numbers("rotor_directions", rotors);
  for (std::size_t n = 0; n < rotors; ++n) {
    if (std::abs(turns[n]) != 1.0) f.fail("rotor_directions", "holds 1 and -1 only");
    // A direction of 1 turns the body counter-clockwise seen from above: the rotor itself turns clockwise.
    v.rotors.push_back({.r_B = flipped(f.vector3(hub(n))), .s = turns[n] > 0 ? -1 : 1});
  }
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  v.g = kGravityRotorpy;
  read_rotors(f, v);
  for (const Entry& e : kPlain) state_unless_zero(v, e.constant, f.number(e.name, 0.0));
  state_unless_zero(v, "blade_flapping.kf", -f.number("k_flap", 0.0));
  state_unless_zero(v, "Jxy", -f.number("Ixy", 0.0));
  state_unless_zero(v, "Jxz", -f.number("Ixz", 0.0));
  state_unless_zero(v, "Jyz", f.number("Iyz", 0.0));
  for (const char* needed : {"mass", "Ixx", "Iyy", "Izz", "k_eta", "k_m"}) f.positive(needed);
  const double least = f.number("rotor_speed_min", 0.0), most = f.positive("rotor_speed_max");
  if (!(most > least) || least < 0) f.fail("rotor_speed_max", "has to be above rotor_speed_min");
  v.parameters["km"] = {as_stated(most - least), {}};
  state_unless_zero(v, "Omega_0", least);
  assume(v, f, "the command is taken as linear from rotor_speed_min to rotor_speed_max");
  set_first_order(v, f.positive("tau_m"), 0.0);
  const double x = f.number("c_Dx", 0.0), y = f.number("c_Dy", 0.0), z = f.number("c_Dz", 0.0);
  state_unless_zero(v, "parasitic_drag.C", (x + y + z) / 3.0);
  if (x != y || x != z)
    assume(v, f,
           fmt::format(
               "c_Dx, c_Dy and c_Dz ({:.4g}, {:.4g}, {:.4g}) become their mean: the drag of the airframe is "
               "the same from every side here",
               x, y, z));
  return v;
}

void stand_in(const Vehicle&, Vehicle& v) { v.g = kGravityRotorpy; }

std::vector<Value> values(const Vehicle& v, const Fields*) {
  std::vector<Value> out;
  for (const Entry& e : kPlain) out.push_back({e.name, {value_or_zero(v, e.constant)}, e.unit, e.constant});
  out.push_back({"k_flap", {-value_or_zero(v, "blade_flapping.kf")}, "N s^2/rad", "-blade_flapping.kf"});
  out.push_back({"Ixy", {-value_or_zero(v, "Jxy")}, "kg m^2", "-Jxy"});
  out.push_back({"Iyz", {value_or_zero(v, "Jyz")}, "kg m^2", "Jyz"});
  out.push_back({"Ixz", {-value_or_zero(v, "Jxz")}, "kg m^2", "-Jxz"});
  for (const char* axis : {"c_Dx", "c_Dy", "c_Dz"})
    out.push_back({axis, {value_or_zero(v, "parasitic_drag.C")}, "N/(m/s)^2", "parasitic_drag.C"});
  out.push_back({"num_rotors", {static_cast<double>(v.rotors.size())}, "-", "rotors"});
  std::vector<double> turns;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    const Vector3d r = flipped(v.rotors[n].r_B);
    out.push_back({hub(n), {r.x(), r.y(), r.z()}, "m", "hub from the centre of gravity; forward, left, up"});
    turns.push_back(-v.rotors[n].s);
  }
  out.push_back({"rotor_directions", turns, "-", "yaw moment on the body, 1 counter-clockwise"});
  out.push_back({"tau_m", {motor_lags(v).up}, "s", "2 zeta_m/omega_m + dead_time"});
  out.push_back({"rotor_speed_min", {value_or_zero(v, "Omega_0")}, "rad/s", "Omega_0"});
  out.push_back({"rotor_speed_max", {full_speed(v)}, "rad/s", "Omega_0 + km"});
  return out;
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out =
      fmt::format("# RotorPy parameters of {}, written by ident.\nimport numpy as np\n\nquad_params = {{\n",
                  values.source);
  std::string hubs;
  for (std::size_t n = 0; n < v.rotors.size(); ++n)
    hubs += fmt::format("        'r{}': np.array([{}]),  # {}\n", n + 1, values.text(hub(n), ", "),
                        values.note(hub(n)));
  for (const Value& value : values.all()) {
    if (value.name == hub(0)) out += "    'rotor_pos': {\n" + hubs + "    },\n";
    if (value.name.starts_with("rotor_pos")) continue;
    const std::string number = values.text(value.name, ", ");
    out += fmt::format("    '{}': {},  # {}\n", value.name,
                       value.numbers.size() > 1 ? "np.array([" + number + "])" : number,
                       values.note(value.name));
  }
  return out +
         "    'rI': np.array([0, 0, 0]),  # m; the IMU\n    'motor_noise_std': 0.0,  # rad/s\n"
         "    'k_w': 1, 'k_v': 10, 'kp_att': 544, 'kd_att': 46.64,  # gains of RotorPy's own "
         "controllers\n}\n";
}

std::vector<std::string> remarks(const Vehicle& v, const Vehicle&) {
  if (v.g == kGravityRotorpy) return {};
  return {fmt::format("RotorPy computes with 9.81 m/s^2, the vehicle file says {:.6g}", v.g)};
}

}  // namespace

SimulatorFormat rotorpy_format() {
  return {.target = "rotorpy",
          .meaning = "RotorPy: a Python file with quad_params",
          .holds = {.centre = Capacity::Centre::by_positions,
                    .tilted_axes = false,
                    .idle_speed = true,
                    .constants = {"rotor_drag.kd", "axial_inflow.kz", "translational_lift.kh",
                                  "blade_flapping.kf", "parasitic_drag.C"},
                    .needs = {"km", "omega_m"}},
          .recognises = recognises,
          .read = read,
          .vehicle = vehicle,
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
