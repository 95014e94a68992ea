// l2f (rl-tools, RAPTOR): the dynamics of a vehicle as JSON.
//
// Forward, left, up. Thrust is a polynomial of the motor's setpoint, 0 to 1; torque is a constant times
// thrust.
#include <Eigen/LU>

#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"
#include "ident/io/simulators/thrust_polynomial.h"

namespace ident {
namespace {

void append(std::vector<double>& list, const Eigen::Vector3d& v) {
  list.insert(list.end(), {v.x(), v.y(), v.z()});
}

std::vector<double> rows(const Eigen::Matrix3d& J) {
  std::vector<double> out;
  for (int i = 0; i < 3; ++i) append(out, J.row(i));
  return out;
}

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const ThrustPolynomial T = thrust_polynomial(v);
  const double idle = value_or_zero(v, "Omega_0"), km = v.value("km");
  std::vector<double> places, axes, turns, thrust;
  const std::size_t n = v.rotors.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Rotor& r = v.rotors[k];
    append(places, flipped(r.r_B)), append(axes, flipped(r.a_B)), append(turns, -r.s * flipped(r.a_B));
    const double ratio = rotor_ratio(v, k);
    append(thrust, ratio * Eigen::Vector3d(T.at(idle), km * (T.b + 2 * T.c * idle), T.c * km * km));
  }
  const Eigen::Matrix3d J = flipped(mass_properties(v).J);
  const MotorLags lags = motor_lags(v);
  return {
      {"mass", {v.value("m")}, "kg", "m"},
      {"gravity", {0, 0, -v.g}, "m/s^2", "gravity"},
      {"J", rows(J), "kg m^2", "J"},
      {"J_inv", rows(J.inverse()), "1/(kg m^2)", "J"},
      {"rotor_positions", places, "m", "hubs"},
      {"rotor_thrust_directions", axes, "-", "thrust axes"},
      {"rotor_torque_directions", turns, "-", "spins"},
      {"rotor_thrust_coefficients", thrust, "N over powers of the setpoint", "kT, Omega_0, km, thrust_curve"},
      {"rotor_torque_constants", std::vector<double>(n, torque_per_thrust(v)), "m", "kQ/kT"},
      {"rotor_time_constants_rising", std::vector<double>(n, lags.up), "s", "2 zeta_m/omega_m + dead_time"},
      {"rotor_time_constants_falling", std::vector<double>(n, lags.down), "s", "the same while slowing down"},
      {"hovering_throttle_relative", {(hover_speed(v) - idle) / km}, "-", "setpoint at hover"},
      {"action_limit", {0, 1}, "-", "setpoints"}};
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out = "{\n  \"dynamics\": {\n", notes;
  for (const Value& value : values.all()) {
    const std::size_t size = value.numbers.size();
    std::string text = values.text(value.name, ", ");
    if (value.name == "action_limit")
      text = "{\"min\": 0, \"max\": 1}";
    else if (size == 3 * v.rotors.size() || size == 9) {
      text.clear();
      for (std::size_t i = 0; i < size; ++i)
        text += (i % 3 ? ", " : i ? "], [" : "[[") + value_text(value.numbers[i]);
      text += "]]";
    } else if (size > 1)
      text = "[" + text + "]";
    out += fmt::format("    \"{}\": {},\n", value.name, text);
    notes += fmt::format("{}\n      \"{}\": \"{}\"", notes.empty() ? "" : ",", value.name,
                         values.note(value.name));
  }
  return out + "    \"notes\": {" + notes + "\n    }\n  }\n}\n";  // JSON has no comments
}

}  // namespace

SimulatorFormat l2f_format() {
  return {.target = "l2f",
          .meaning = "l2f (rl-tools, RAPTOR): dynamics as JSON",
          .holds = {.centre = Capacity::Centre::by_positions,
                    .each_rotor = true,
                    .up_and_down = true,
                    .idle_speed = true,
                    .constants = {"thrust_curve.c", "thrust_curve.offset"},
                    .needs = {"km", "omega_m"}},
          .values = values,
          .page = page};
}

}  // namespace ident
