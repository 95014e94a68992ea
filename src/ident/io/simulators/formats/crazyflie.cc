// Crazyflie firmware: constants of a platform_defaults_*.h, as C.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"
#include "ident/io/simulators/thrust_polynomial.h"

namespace ident {
namespace {

const std::vector<FixedRotor> kLayout = {{1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, -1}};

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const ThrustPolynomial T = thrust_polynomial(v);
  return {{"CF_MASS", {v.value("m")}, "kg", "m"},
          {"ARM_LENGTH", {std::hypot(v.rotors[0].r_B.x(), v.rotors[0].r_B.y())}, "m", "hubs"},
          {"THRUST_MIN", {T.at(value_or_zero(v, "Omega_0"))}, "N", "of one motor at command 0"},
          {"THRUST_MAX", {T.at(full_speed(v))}, "N", "of one motor at command 1"},
          {"THRUST2TORQUE", {torque_per_thrust(v)}, "m", "kQ/kT"}};
}

std::string page(const Vehicle& v, const Values& values) {
  std::string out = fmt::format(
      "// Crazyflie platform constants of {}, written by ident.\n// Inertia for a controller's gains: {} {} "
      "{} "
      "kg m^2.\n#pragma once\n\n",
      values.source, v.value("Jxx"), v.value("Jyy"), v.value("Jzz"));
  for (const Value& value : values.all()) {
    std::string number = values.text(value.name);
    if (number.find_first_of(".e") == std::string::npos) number += ".0";
    out += fmt::format("#define {} {}f  // {}\n", value.name, number, values.note(value.name));
  }
  return out;
}

std::vector<std::string> remarks(const Vehicle&, const Vehicle&) {
  return {
      "VMOTOR2THRUST0..3 go by the motor's voltage, which no constant of the vehicle does: they are left as "
      "they are"};
}

}  // namespace

SimulatorFormat crazyflie_format() {
  return {.target = "crazyflie",
          .meaning = "Crazyflie firmware: a platform_defaults header",
          .holds = {.products = false,
                    .centre = Capacity::Centre::none,
                    .tilted_axes = false,
                    .heights = false,
                    .motor = Capacity::Motor::instant,
                    .idle_speed = true,
                    .layout = kLayout,
                    .constants = {"thrust_curve.c", "thrust_curve.offset"},
                    .needs = {"km"}},
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
