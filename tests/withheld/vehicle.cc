// Draws vehicles from 0.03 to 5 kg whose parts fit each other: arm, propeller, inertia, motor.
#include "vehicle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace withheld {

double Vehicle::hover_speed() const {
  double lift = 0;
  for (const Rotor& rotor : rotors) lift -= rotor.a.z();
  return std::sqrt(m * gravity / (kT * lift));
}

double Vehicle::induced_speed() const {
  return std::sqrt(m * gravity / kRotors / (2 * air_density * M_PI * radius * radius));
}

namespace {

std::array<Rotor, kRotors> place_rotors(const Vehicle& v) {
  const double l = v.arm, h = -v.hub_height, d = v.arm / std::sqrt(2.0);
  const Eigen::Vector3d up(0, 0, -1);
  if (v.layout == "x") {
    return {Rotor{{d, d, h}, up, 1}, Rotor{{d, -d, h}, up, -1}, Rotor{{-d, -d, h}, up, 1},
            Rotor{{-d, d, h}, up, -1}};
  }
  const double sa = std::sin(v.slant), ca = std::cos(v.slant);
  const double left_right = v.layout == "4sp" ? 1 : -1;
  return {Rotor{{l, 0, h}, up, 1}, Rotor{{0, -l, h}, {-sa, 0, -ca}, left_right}, Rotor{{-l, 0, h}, up, 1},
          Rotor{{0, l, h}, {sa, 0, -ca}, left_right}};
}

}  // namespace

Vehicle draw_vehicle(Random& random) {
  Vehicle v;
  const double kind = random.uniform(0, 1);
  v.layout = kind < 0.4 ? "x" : kind < 0.7 ? "plus" : "4sp";
  v.m = random.log_uniform(0.03, 5);
  v.arm = std::clamp(0.17 * std::pow(v.m / 0.5, 0.4) * std::exp(random.normal(0, 0.12)), 0.03, 0.5);
  v.radius = v.arm * random.uniform(0.38, 0.62);
  v.short_form = random.chance(0.3);
  v.hub_height = v.short_form ? 0 : v.arm * random.uniform(0.01, 0.06);

  // Hover at a tip speed of 38 to 75 m/s; torque from the figure of merit FM = T v_h/(Q Omega).
  const double hover = random.uniform(38, 75) / v.radius;
  v.kT = v.m * v.gravity / (kRotors * hover * hover);
  v.kQ = v.kT * v.induced_speed() / (hover * random.uniform(0.45, 0.75));
  v.km = hover * std::sqrt(random.uniform(1.6, 5.0));
  v.omega_m = std::clamp(random.log_uniform(8, 80) * std::pow(v.m / 0.5, -0.15), 5.0, 80.0);
  v.zeta_m = random.log_uniform(0.4, 2.0);

  v.J.x() = v.m * v.arm * v.arm * random.uniform(0.12, 0.25);
  v.J.y() = v.J.x() * random.uniform(0.85, 1.2);
  v.J.z() = (v.J.x() + v.J.y()) * random.uniform(0.75, 0.95);

  if (v.layout == "4sp") v.slant = std::atan(2 * v.kQ / (v.arm * v.kT));
  v.rotors = place_rotors(v);
  v.pulse_min = random.integer(1000, 1150);
  v.pulse_max = random.integer(1850, 2000);
  v.cells = std::clamp(static_cast<int>(std::lround(2.6 * std::pow(v.m / 0.5, 0.5))), 1, 6);
  v.endurance = random.uniform(300, 900);
  return v;
}

double attitude_bandwidth(const Vehicle& v) {
  return std::clamp(0.3 * v.omega_m / std::max(1.0, v.zeta_m), 2.2, 7.0);
}

const std::vector<std::string>& base_parameter_names() {
  static const std::vector<std::string> names = {"m",      "kT",  "kQ",  "km", "omega_m",
                                                 "zeta_m", "Jxx", "Jyy", "Jzz"};
  return names;
}

double& base_parameter(Vehicle& v, const std::string& name) {
  if (name == "m") return v.m;
  if (name == "kT") return v.kT;
  if (name == "kQ") return v.kQ;
  if (name == "km") return v.km;
  if (name == "omega_m") return v.omega_m;
  if (name == "zeta_m") return v.zeta_m;
  if (name == "Jxx") return v.J.x();
  if (name == "Jyy") return v.J.y();
  if (name == "Jzz") return v.J.z();
  throw std::invalid_argument("no base parameter is called " + name);
}

double base_parameter(const Vehicle& v, const std::string& name) {
  return base_parameter(const_cast<Vehicle&>(v), name);
}

}  // namespace withheld
