// crazyflow: one table of params.toml of its first-principles model [crazyflow/dynamics/first_principles].
//
// Forward, left, up. Thrust and torque are polynomials of rpm; rotor_dyn_coef = 1/tau up, -, 1/tau down, -;
// hubs at L times the signs of the mixing matrix; drag_matrix, written "1/s" there, is a force over velocity,
// kg/s.
#include <numbers>

#include "ident/core/error.h"
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/readers/toml_fields.h"
#include "ident/io/simulators/simulator_format.h"
#include "ident/io/simulators/thrust_polynomial.h"

namespace ident {
namespace {

constexpr double kGravity = 9.81;                    // m/s^2 of crazyflow
constexpr double kPerRpm = std::numbers::pi / 30.0;  // rad/s

bool recognises(std::string_view text) {
  return text.find("rpm2thrust") != std::string_view::npos &&
         text.find("mixing_matrix") != std::string_view::npos && text.find('[') != std::string_view::npos &&
         text.find("rotor_dyn_coef") != std::string_view::npos;
}

/// The only vehicle of the file, its fields without the table's name.
Fields read(const std::string& text, const std::string& file) {
  const std::vector<std::string> tables = toml_tables(text, file);
  if (tables.size() != 1)
    throw InputError(file, 0, "",
                     fmt::format("holds {} vehicles ({}): leave one in a file of its own", tables.size(),
                                 fmt::join(tables, ", ")));
  const Fields whole = toml_fields(text, file);
  Fields fields(text, file);
  for (const auto& [name, field] : whole.all())
    fields.add(name.substr(std::min(tables[0].size() + 1, name.size())), field);
  return fields;
}

ThrustPolynomial polynomial(const Fields& f, const char* name) {
  const std::vector<double> c = f.numbers(name, 3);
  return {c[0], c[1] / kPerRpm, c[2] / (kPerRpm * kPerRpm)};
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  v.g = kGravity;
  const std::vector<double> J = f.numbers("J", 9), mixing = f.numbers("mixing_matrix", 12),
                            drag = f.numbers("drag_matrix", 9);
  const double L = f.positive("L");
  for (std::size_t n = 0; n < 4; ++n)
    v.rotors.push_back({.r_B = flipped(Eigen::Vector3d(-mixing[4 + n] * L, mixing[n] * L, 0.0)),
                        .s = mixing[8 + n] > 0 ? -1 : 1});
  MassProperties body{.m = f.positive("mass"), .Jp = f.number("prop_inertia", 0.0)};
  body.J = flipped(Eigen::Matrix3d(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(J.data())));
  set_mass_properties(v, body);
  const ThrustPolynomial thrust = polynomial(f, "rpm2thrust"), torque = polynomial(f, "rpm2torque");
  if (!set_thrust_polynomial(v, thrust)) f.fail("rpm2thrust", "does not reach the weight at any speed");
  const double hover = hover_speed(v);
  v.parameters["kQ"] = {torque.a == 0 && torque.b == 0 ? torque.c : torque.at(hover) / (hover * hover), {}};
  if (torque.a != 0 || torque.b != 0) assume(v, f, "rpm2torque becomes kQ, which agrees at hover");
  const double least = thrust.speed(f.number("thrust_min")), most = thrust.speed(f.positive("thrust_max"));
  if (!(most > least)) f.fail("thrust_max", "is not above thrust_min");
  v.parameters["km"] = {as_stated(most - std::max(least, 0.0)), {}};
  state_unless_zero(v, "Omega_0", as_stated(std::max(least, 0.0)));
  assume(v, f,
         "the command is taken as linear in rotor speed, from that of thrust_min to that of thrust_max");
  const std::vector<double> lag = f.numbers("rotor_dyn_coef", 4);
  const double up = lag[0] + 2 * lag[1] * hover / kPerRpm,
               down = lag[2] + 2 * lag[3] * hover / kPerRpm;  // about hover
  if (!(up > 0) || !(down > 0)) f.fail("rotor_dyn_coef", "leaves the rotors without dynamics");
  if (lag[1] != 0 || lag[3] != 0) assume(v, f, "quadratic terms of rotor_dyn_coef are taken at hover");
  set_first_order(v, 1 / up, 1 / down);
  state_unless_zero(v, "rotor_drag.kd", -(drag[0] + drag[4]) / 2 / (4 * hover));
  state_unless_zero(v, "axial_inflow.kz", -drag[8] / (4 * hover));
  if (drag[0] != 0) assume(v, f, "drag_matrix becomes rotor_drag and axial_inflow, which agree at hover");
  return v;
}

/// Hubs on the diagonals at the same distance, and no rotor momentum where the spins do not cancel:
/// crazyflow's gyroscopic torque has the same sign about both axes.
void stand_in(const Vehicle&, Vehicle& v) {
  v.g = kGravity;
  double L = 0.0;
  int spins = 0;
  for (const Rotor& r : v.rotors)
    L += (std::abs(r.r_B.x()) + std::abs(r.r_B.y())) / 2 / static_cast<double>(v.rotors.size());
  for (Rotor& r : v.rotors) {
    if (r.r_B.x() == 0 || r.r_B.y() == 0 || v.rotors.size() != 4)
      throw UsageError("crazyflow holds a quadrotor X only");
    r.r_B = {as_stated(std::copysign(L, r.r_B.x())), as_stated(std::copysign(L, r.r_B.y())), 0.0};
    spins += r.s;
  }
  if (spins != 0) v.parameters.erase("Jp");
  // The least speed is known by its thrust there: where a curve falls at first, that is beyond its lowest
  // point.
  const ThrustPolynomial T = thrust_polynomial(v);
  if (T.a == 0 && T.b == 0) return;
  const double full = full_speed(v), least = T.speed(T.at(value_or_zero(v, "Omega_0")));
  v.parameters.erase("Omega_0");
  state_unless_zero(v, "Omega_0", as_stated(std::max(least, 0.0)));
  v.parameters["km"] = {as_stated(full - std::max(least, 0.0)), {}};
}

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const Eigen::Matrix3d J = flipped(mass_properties(v).J);
  const ThrustPolynomial T = thrust_polynomial(v);
  const double drag = -4 * value_or_zero(v, "rotor_drag.kd") * hover_speed(v), up = motor_lags(v).up,
               down = motor_lags(v).down;
  std::vector<double> mixing;
  for (int row = 0; row < 3; ++row)
    for (const Rotor& r : v.rotors)
      mixing.push_back(row == 0 ? (r.r_B.y() > 0 ? -1 : 1) : row == 1 ? (r.r_B.x() > 0 ? -1 : 1) : -r.s);
  return {{"mass", {v.value("m")}, "kg", "m"},
          {"J",
           {J(0, 0), J(0, 1), J(0, 2), J(1, 0), J(1, 1), J(1, 2), J(2, 0), J(2, 1), J(2, 2)},
           "kg m^2",
           "J, forward, left, up"},
          {"thrust_min", {T.at(value_or_zero(v, "Omega_0"))}, "N", "thrust at command 0"},
          {"thrust_max", {T.at(full_speed(v))}, "N", "thrust at command 1"},
          {"L", {std::abs(v.rotors[0].r_B.x())}, "m", "hubs"},
          {"prop_inertia", {value_or_zero(v, "Jp")}, "kg m^2", "Jp"},
          {"rpm2thrust",
           {T.a, T.b * kPerRpm, T.c * kPerRpm * kPerRpm},
           "N over powers of rpm",
           "kT, thrust_curve"},
          {"rpm2torque", {0, 0, v.value("kQ") * kPerRpm * kPerRpm}, "N m over powers of rpm", "kQ"},
          {"rotor_dyn_coef", {1 / up, 0, 1 / down, 0}, "1/s", "omega_m/(2 zeta_m), with the dead time"},
          {"mixing_matrix", mixing, "-", "signs of the moments: roll, pitch, yaw by rotor"},
          {"drag_matrix",
           {drag, 0, 0, 0, drag, 0, 0, 0, -4 * value_or_zero(v, "axial_inflow.kz") * hover_speed(v)},
           "kg/s",
           "-4 Omega_hover (rotor_drag.kd, axial_inflow.kz)"}};
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out = fmt::format("# {}, written by ident: a table of crazyflow's params.toml.\n[{}]\n",
                                values.source, v.name.empty() ? "vehicle" : "\"" + v.name + "\"");
  for (const Value& value : values.all()) {
    std::string text = value.numbers.size() == 1 ? values.text(value.name) : "";
    const std::size_t row = value.numbers.size() == 9 ? 3 : value.numbers.size() == 12 ? 4 : 0;
    for (std::size_t i = 0; i < value.numbers.size() && value.numbers.size() > 1; ++i) {
      std::string number = value_text(value.numbers[i]);
      if (number.find_first_of(".en") == std::string::npos) number += ".0";
      text += (row && i % row == 0 ? (i ? "], [" : "[") : i ? ", " : "") + number;
    }
    if (value.numbers.size() == 1 && text.find_first_of(".en") == std::string::npos) text += ".0";
    if (value.numbers.size() > 1) text = "[" + text + (row ? "]]" : "]");
    out += fmt::format("{} = {}  # {}\n", value.name, text, values.note(value.name));
  }
  return out;
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle& v) {
  std::vector<std::string> out;
  if (v.has("rotor_drag.kd") || v.has("axial_inflow.kz"))
    out.push_back(
        "drag does not change with rotor speed there, and acts at the centre of gravity: it agrees at hover");
  if (v.has("thrust_curve.c") || v.has("thrust_curve.offset"))
    out.push_back("the thrust curve becomes a polynomial that agrees to second order at hover");
  if (mass_properties(whole).Jp != 0 && !v.has("Jp"))
    out.push_back(
        "prop_inertia is 0: crazyflow's gyroscopic torque has the wrong sign for spins that do not cancel");
  return out;
}

}  // namespace

SimulatorFormat crazyflow_format() {
  return {
      .target = "crazyflow",
      .meaning = "crazyflow: a table of params.toml",
      .holds = {.centre = Capacity::Centre::none,
                .tilted_axes = false,
                .heights = false,
                .up_and_down = true,
                .idle_speed = true,
                .rotor_momentum = true,
                .constants = {"rotor_drag.kd", "axial_inflow.kz", "thrust_curve.c", "thrust_curve.offset"},
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
