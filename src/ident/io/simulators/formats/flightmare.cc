// Flightmare: quadrotor_dynamics of its YAML file. The inertia is not in it: m l^2/12 (4.5, 4.5, 7) in the
// code.
#include "ident/io/simulators/entries.h"
#include "ident/io/simulators/simulator_format.h"
#include "ident/io/simulators/thrust_polynomial.h"

namespace ident {
namespace {

const std::vector<FixedRotor> kLayout = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};

double arm(const Vehicle& v) { return std::hypot(v.rotors[0].r_B.x(), v.rotors[0].r_B.y()); }

std::vector<Value> values(const Vehicle& v, const Fields*) {
  const ThrustPolynomial T = thrust_polynomial(v);
  return {{"mass", {v.value("m")}, "kg", "m"},
          {"arm_l", {arm(v)}, "m", "hubs"},
          {"motor_omega_min", {value_or_zero(v, "Omega_0")}, "rad/s", "Omega_0"},
          {"motor_omega_max", {full_speed(v)}, "rad/s", "Omega_0 + km"},
          {"motor_tau", {motor_lags(v).up}, "s", "2 zeta_m/omega_m + dead_time"},
          {"thrust_map", {T.c, T.b, T.a}, "N over falling powers of rad/s", "kT, thrust_curve"},
          {"kappa", {torque_per_thrust(v)}, "m", "kQ/kT"}};
}

std::string page(const Vehicle&, const Values& values) {
  std::string out = fmt::format("# Flightmare, {}, written by ident.\nquadrotor_dynamics:\n", values.source);
  for (const Value& value : values.all()) {
    const std::string text = values.text(value.name, ", ");
    out += fmt::format("  {}: {}  # {}\n", value.name, value.numbers.size() > 1 ? "[" + text + "]" : text,
                       values.note(value.name));
  }
  return out + "  omega_max: [6.0, 6.0, 6.0]  # rad/s; of Flightmare's own controller\n";
}

std::vector<std::string> remarks(const Vehicle& whole, const Vehicle& v) {
  const Eigen::Vector3d J = mass_properties(whole).J.diagonal();
  const double unit = v.value("m") * arm(v) * arm(v) / 12;
  return {
      fmt::format("Flightmare computes the inertia from mass and arm, [{:.3g}, {:.3g}, {:.3g}] kg m^2, where "
                  "the vehicle has "
                  "[{:.3g}, {:.3g}, {:.3g}]: change updateDynamics in its code",
                  4.5 * unit, 4.5 * unit, 7 * unit, J.x(), J.y(), J.z())};
}

}  // namespace

SimulatorFormat flightmare_format() {
  return {.target = "flightmare",
          .meaning = "Flightmare: quadrotor_dynamics of its YAML file",
          .holds = {.products = false,
                    .centre = Capacity::Centre::none,
                    .tilted_axes = false,
                    .heights = false,
                    .idle_speed = true,
                    .layout = kLayout,
                    .constants = {"thrust_curve.c", "thrust_curve.offset"},
                    .needs = {"km", "omega_m"}},
          .values = values,
          .page = page,
          .remarks = remarks};
}

}  // namespace ident
