// ArduPilot SITL: the frame's JSON file for `--model "+:frame.json"` [SIM_Frame.cpp, SIM_Motor.cpp].
//
//   T = (m g/(n hoverThrOut)) ((1 - e) c + e c^2), e = propExpo; yaw torque 0.05 diagonal_size T c motorN_yaw
//   m g tan(refAngle) = drag at refSpd
#include <numbers>

#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/readers/yaml_fields.h"
#include "ident/io/simulators/simulator_format.h"

namespace ident {
namespace {

constexpr double kGravity = 9.80665;      // GRAVITY_MSS of ArduPilot
constexpr double kYawScale = 0.05;        // SIM_Motor.cpp
constexpr double kReferenceSpeed = 10.0;  // m/s of a new file, at which the drag agrees
constexpr double kDegree = std::numbers::pi / 180.0;

std::string key(std::size_t n, const char* part) { return fmt::format("motor{}_{}", n + 1, part); }

bool recognises(std::string_view text) {
  return yaml_has_keys(text, {"hoverThrOut", "mass"}) || yaml_has_keys(text, {"refAngle", "propExpo"});
}

Fields read(const std::string& text, const std::string& file) { return yaml_fields(text, file); }

/// Command at hover of a thrust curve (1 - e) c + e c^2.
double hover_command(double e, double share) {
  if (std::abs(e) < 1e-12) return share;
  return (-(1 - e) + std::sqrt((1 - e) * (1 - e) + 4 * e * share)) / (2 * e);
}

/// Part of the full speed that is there at command 0, so that hover agrees: (a + (1 - a) c)^2 = share.
double idle_share(double c, double share) { return (std::sqrt(share) - c) / (1 - c); }

/// The assumed full speed, a part of it without command; so rounded that both make the full speed again.
void set_idle(Vehicle& v, double idle) {
  const double Omega_0 = std::round(kAssumedFullSpeed * idle * 1e10) / 1e10;
  v.parameters.erase("Omega_0");
  state_unless_zero(v, "Omega_0", Omega_0);
  v.parameters["km"] = {as_stated(kAssumedFullSpeed - Omega_0), {}};
}

void read_rotors(const Fields& f, Vehicle& v, double hover) {
  const double count = f.number("num_motors", 4.0);
  if (count < 1 || count > 8 || count != std::floor(count)) f.fail("num_motors", "has to be 1 to 8");
  const double size = f.positive("diagonal_size");
  if (!f.has(key(0, "position"))) {
    if (count != 4) f.fail("num_motors", "without motorN_position only a quadrotor X is read");
    v.rotors = layout_rotors("x", size, 0.0);
    std::swap(v.rotors[1], v.rotors[2]);  // ArduPilot: front right, back left, front left, back right
    assume(
        v, f,
        "no motorN_position: an X with arms of diagonal_size, as ArduPilot computes, in its order of motors");
    return;
  }
  double torque = 0.0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    Rotor rotor{.r_B = f.vector3(key(n, "position"))};
    if (f.has(key(n, "vector"))) rotor.a_B = f.vector3(key(n, "vector"));
    if (!(rotor.a_B.norm() > 1e-6)) f.fail(key(n, "vector"), "has no direction");
    rotor.a_B.normalize();
    const double yaw = f.number(key(n, "yaw"), n % 4 < 2 ? 1.0 : -1.0);
    rotor.s = yaw < 0 ? -1 : 1;
    torque += std::abs(yaw) / count;
    v.rotors.push_back(rotor);
  }
  v.parameters["kQ"] = {torque * kYawScale * size * hover, {}};  // over kT, until that is known
}

void read_body(const Fields& f, Vehicle& v) {
  const double m = f.positive("mass"), half = f.positive("diagonal_size") / 2;
  v.parameters["m"] = {m, {}};
  Eigen::Vector3d J = f.has("moment_inertia") ? f.vector3("moment_inertia") : Eigen::Vector3d(0, 0, 0);
  if (J.isZero(0.0)) {  // SIM_Frame.cpp: half of the mass on a ring
    J = {m * 0.25 * half * half, m * 0.25 * half * half, m * 0.5 * half * half};
    assume(v, f, "no moment_inertia: that of half the mass on a ring, as ArduPilot computes");
  }
  v.parameters["Jxx"] = {J.x(), {}}, v.parameters["Jyy"] = {J.y(), {}}, v.parameters["Jzz"] = {J.z(), {}};
  const double speed = f.number("refSpd", 15.08), angle = f.number("refAngle", 45.0);
  if (speed > 0 && angle > 0 && angle < 90)
    state_unless_zero(v, "parasitic_drag.C", m * kGravity * std::tan(angle * kDegree) / (speed * speed));
  if (f.number("mdrag_coef", 0.2) != 0.0)
    assume(
        v, f,
        "mdrag_coef: the momentum drag of the rotors is taken into parasitic_drag, which agrees at refSpd");
}

Vehicle vehicle(const Fields& f) {
  Vehicle v;
  v.g = kGravity;
  read_body(f, v);
  const double share = f.positive("hoverThrOut"), e = f.number("propExpo", 0.65);
  if (!(share < 1.0)) f.fail("hoverThrOut", "has to be below 1");
  if (!(e >= -1.0 && e <= 1.0)) f.fail("propExpo", "has to be between -1 and 1");
  const double hover = hover_command(e, share), idle = idle_share(hover, share);
  read_rotors(f, v, hover);
  const double thrust = f.number("mass") * kGravity / (static_cast<double>(v.rotors.size()) * share);
  const double per_thrust = v.has("kQ") ? v.value("kQ") : kYawScale * f.number("diagonal_size") * hover;
  set_by_full_thrust(v, thrust, thrust * per_thrust);
  set_idle(v, idle);
  const double low = f.number("pwmMin", 1000.0), range = f.number("pwmMax", 2000.0) - low;
  const double from = f.number("spin_min", 0.15), to = f.number("spin_max", 0.95);
  if (!(range > 0) || !(to > from)) f.fail("pwmMax", "leaves no range of the command");
  v.command = CommandRange{as_stated(low + from * range), as_stated(low + to * range)};
  assume(v, f,
         fmt::format("SITL knows no rotor speed: {} rad/s at full command are assumed; propExpo becomes an "
                     "offset of the "
                     "speed that agrees at hover and at full command",
                     kAssumedFullSpeed));
  assume(v, f,
         "yaw torque of SITL goes with thrust times command: it agrees at hover; motors have no lag there");
  return v;
}

double idle_of(const Vehicle& v) { return value_or_zero(v, "Omega_0") / full_speed(v); }

void stand_in(const Vehicle& whole, Vehicle& v) {
  const double idle = idle_of(v), thrust = full_thrust(v);
  set_by_full_thrust(v, thrust, thrust * torque_per_thrust(v));
  set_idle(v, idle);
  v.parameters.erase("parasitic_drag.C");
  state_unless_zero(v, "parasitic_drag.C",
                    as_stated(whole_linear_drag(whole, kReferenceSpeed) / kReferenceSpeed));
  if (!v.command) v.command = CommandRange{1000.0, 2000.0};
  v.g = kGravity;
}

std::vector<Value> values(const Vehicle& v, const Fields* own) {
  const double n = static_cast<double>(v.rotors.size()), m = v.value("m"), idle = idle_of(v);
  const double share = m * kGravity / (n * full_thrust(v)), c = (std::sqrt(share) - idle) / (1 - idle);
  const double speed = own ? own->number("refSpd", kReferenceSpeed) : kReferenceSpeed;
  double size = 0.0;
  for (const Rotor& r : v.rotors) size = std::max(size, 2 * std::hypot(r.r_B.x(), r.r_B.y()));
  if (own) size = own->number("diagonal_size", size);
  std::vector<Value> out = {
      {"mass", {m}, "kg", "m"},
      {"diagonal_size", {size}, "m", "twice the longest arm"},
      {"moment_inertia", {v.value("Jxx"), v.value("Jyy"), v.value("Jzz")}, "kg m^2", "Jxx, Jyy, Jzz"},
      {"hoverThrOut", {share}, "-", "m g over the thrust at full command"},
      {"propExpo", {(share - c) / (c * c - c)}, "-", "thrust over command, exact at hover"},
      {"refSpd", {speed}, "m/s", "speed of the drag below"},
      {"refAngle",
       {std::atan(value_or_zero(v, "parasitic_drag.C") * speed * speed / (m * kGravity)) / kDegree},
       "deg",
       "drag of airframe and rotors at refSpd"},
      {"num_motors", {n}, "-", "rotors"}};
  if (own && !own->has(key(0, "position"))) return out;
  for (std::size_t k = 0; k < v.rotors.size(); ++k) {
    const Rotor& r = v.rotors[k];
    out.push_back({key(k, "position"), {r.r_B.x(), r.r_B.y(), r.r_B.z()}, "m", "hub, forward, right, down"});
    out.push_back({key(k, "vector"), {r.a_B.x(), r.a_B.y(), r.a_B.z()}, "-", "thrust axis"});
    out.push_back(
        {key(k, "yaw"), {r.s * torque_per_thrust(v) / (kYawScale * size * c)}, "-", "kQ/kT, exact at hover"});
  }
  if (own) return out;
  out.push_back({"pwmMin", {v.command->min_us}, "us", "command"});
  out.push_back({"pwmMax", {v.command->max_us}, "us", "command"});
  return out;
}

std::string page(const Vehicle&, const Values& values) {
  std::string out = fmt::format(
      "# ArduPilot SITL frame of {}, written by ident: sim_vehicle.py --model \"+:THIS FILE\"\n{{\n",
      values.source);
  for (const Value& value : values.all()) {
    const std::string number = values.text(value.name, ", ");
    out += fmt::format("  # {}\n  \"{}\": {},\n", values.note(value.name), value.name,
                       value.numbers.size() > 1 ? "[" + number + "]" : number);
  }
  return out +
         "  # commands from 0 to 1 over the whole range, no slew limit\n  \"spin_min\": 0, \"spin_max\": 1, "
         "\"slew_max\": 0,\n"
         "  # V, A, Ohm, m, degC: a battery that does not sag\n  \"refVoltage\": 12.6, \"maxVoltage\": 12.6, "
         "\"refCurrent\": "
         "10, \"refBatRes\": 0,\n  \"battCapacityAh\": 0, \"refAlt\": 0, \"refTempC\": 15, \"refRotRate\": "
         "120,\n"
         "  # the drag of the rotors is in refAngle\n  \"mdrag_coef\": 0\n}\n";
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle&) {
  std::vector<std::string> out = {
      "SITL's yaw torque goes with thrust times command and its thrust with a polynomial of the command: "
      "both agree at hover"};
  if (whole_linear_drag(whole, kReferenceSpeed) > 0)
    out.push_back(fmt::format("drag of rotors and airframe becomes a quadratic one that agrees at {} m/s",
                              kReferenceSpeed));
  return out;
}

}  // namespace

SimulatorFormat ardupilot_format() {
  return {.target = "ardupilot",
          .meaning = "ArduPilot SITL: the JSON file of a frame",
          .holds = {.products = false,
                    .centre = Capacity::Centre::by_positions,
                    .motor = Capacity::Motor::instant,
                    .idle_speed = true,
                    .constants = {"parasitic_drag.C"},
                    .replaced = {"rotor_drag.kd", "Kdx", "Kdy", "Kdz"},
                    .needs = {"km"},
                    .rotor_speeds = false},
          .recognises = recognises,
          .read = read,
          .vehicle = vehicle,
          .stand_in = stand_in,
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
