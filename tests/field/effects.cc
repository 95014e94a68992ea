// Draws sizes and applies them to forces and moments.
#include "effects.h"

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

namespace field {
namespace {

using Change = std::function<void(Effects&)>;

const std::map<std::string, Change>& removals() {
  static const std::map<std::string, Change> table{
      {"rotor_drag", [](Effects& e) { e.kd = e.tilt = 0; }},
      {"parasitic_drag", [](Effects& e) { e.C.setZero(); }},
      {"translational_lift", [](Effects& e) { e.translational = false; }},
      {"axial_inflow", [](Effects& e) { e.axial = false; }},
      {"blade_flapping", [](Effects& e) { e.kf = e.tilt = 0; }},
      {"ground_effect", [](Effects& e) { e.ground_radius = 0; }},
      {"wind", [](Effects& e) { e.wind_W.setZero(); }},
      {"rotor_mismatch", [](Effects& e) { e.weak_rotor = -1, e.weak_ratio = 1; }},
      {"cg_offset", [](Effects& e) { e.c_B.setZero(); }},
      {"products_of_inertia", [](Effects& e) { e.products.setZero(); }},
      {"gyroscopic", [](Effects& e) { e.rotor_momentum = false; }},
      {"imu_bias", [](Effects& e) { e.imu_bias.setZero(); }},
      {"imu_lever_arm", [](Effects& e) { e.imu_r_B.setZero(); }},
      {"imu_misalignment", [](Effects& e) { e.imu_turn.setZero(); }},
      {"propwash", [](Effects& e) { e.propwash = 0; }},
  };
  return table;
}

Vector3d spread(Random& random, double size) {
  return size * Vector3d(random.normal(), random.normal(), random.normal());
}

using Draw = std::function<void(Effects&, Random&, const Vehicle&)>;

// What is not on every vehicle but inside the catalogue.
const std::map<std::string, Draw>& catalogue_extras() {
  static const std::map<std::string, Draw> table{
      {"ground_effect",
       [](Effects& e, Random& r, const Vehicle& v) { e.ground_radius = v.radius * r.uniform(1.0, 1.5); }},
      {"rotor_mismatch",
       [](Effects& e, Random& r, const Vehicle& v) {
         e.weak_rotor = r.integer(0, v.rotors() - 1), e.weak_ratio = 1 - r.uniform(0.03, 0.1);
       }},
      {"cg_offset",
       [](Effects& e, Random& r, const Vehicle& v) {
         e.c_B = Vector3d(r.normal(), r.normal(), 0.5 * r.normal()) * 0.015 * v.l;
       }},
      {"products_of_inertia",
       [](Effects& e, Random& r, const Vehicle& v) {
         e.products = 0.02 * v.J.x() * Vector3d(r.normal(), r.normal(), r.normal());
       }},
      {"imu_bias", [](Effects& e, Random& r, const Vehicle&) { e.imu_bias = spread(r, 0.1); }},
      {"imu_lever_arm", [](Effects& e, Random& r, const Vehicle& v) { e.imu_r_B = spread(r, 0.06 * v.l); }},
      {"imu_misalignment", [](Effects& e, Random& r, const Vehicle&) { e.imu_turn = spread(r, 0.012); }},
  };
  return table;
}

const std::map<std::string, Draw>& outside_extras() {
  static const std::map<std::string, Draw> table{
      {"flexible_arms",
       [](Effects& e, Random& r, const Vehicle& v) {
         e.arm_hz = r.uniform(25, 60) * (v.m > 1 ? 0.7 : 1.0), e.arm_damping = r.uniform(0.04, 0.12);
       }},
      {"slosh",
       [](Effects& e, Random& r, const Vehicle&) {
         e.slosh_share = r.uniform(0.04, 0.15), e.slosh_hz = r.uniform(1.2, 3.0);
       }},
      {"propwash", [](Effects& e, Random& r, const Vehicle&) { e.propwash = r.uniform(0.06, 0.2); }},
      {"downwash_bursts", [](Effects& e, Random&, const Vehicle&) { e.bursts = true; }},
      {"vibration", [](Effects& e, Random& r, const Vehicle&) { e.vibration = r.log_uniform(0.5, 5); }},
      {"esc_dead_zone", [](Effects& e, Random& r, const Vehicle&) { e.dead_zone = r.uniform(0.004, 0.015); }},
  };
  return table;
}

void add_extra(Effects& e, Random& random, const Vehicle& v, const std::string& name) {
  const bool known = catalogue_extras().contains(name);
  if (!known && !outside_extras().contains(name)) throw std::invalid_argument("unknown effect: " + name);
  (known ? catalogue_extras() : outside_extras()).at(name)(e, random, v);
  e.extra.push_back(name);
}

void draw_air_loads(Effects& e, Random& random, const Vehicle& v) {
  const double area = v.disc();
  const double lift_slope = random.uniform(4.5, 6.0), solidity = random.uniform(0.07, 0.14);
  if (random.chance(0.9)) {
    e.blade_slope = kAirDensity * lift_slope * solidity * area * v.radius / 4;
    e.axial = e.translational = true;
  }
  if (random.chance(0.9)) {  // 0.15 to 0.45 1/s at hover
    e.kd = random.uniform(0.15, 0.45) * v.m / (v.rotors() * v.hover_speed());
  }
  if (random.chance(0.8)) {
    const double thrust = v.m * kGravity / v.rotors();
    const double lean = random.uniform(0.6, 2.5) * 0.01745 / 5;  // rad per m/s at hover
    e.tilt = lean * v.hover_speed() * v.radius;
    // A stiff hub carries part of the tilt as a moment: lever of 10 to 40 % of the radius.
    e.kf = thrust * lean * v.radius * random.uniform(0.1, 0.4) / v.hover_speed();
  }
  if (random.chance(0.8)) {
    const double front = random.uniform(0.25, 0.6) * v.l * v.l;
    e.C = 0.5 * kAirDensity * front * Vector3d(1, random.uniform(0.9, 1.2), random.uniform(1.2, 2.2));
  }
}

}  // namespace

Effects without(Effects e, const std::string& cause) {
  removals().at(cause)(e);
  return e;
}

Effects draw_effects(Random& random, const Vehicle& v, bool plain, const std::string& only) {
  Effects e;
  if (plain) {  // only what the vehicle file will state
    if (random.chance(0.5)) e.kd = random.uniform(0.15, 0.45) * v.m / (v.rotors() * v.hover_speed());
    if (random.chance(0.5)) e.sag_exponent = 1;
    return e;
  }
  draw_air_loads(e, random, v);
  e.sag_exponent = random.chance(0.7) ? random.uniform(0.85, 1.0) : 0;  // 0: the ESC governs the speed
  if (!only.empty() && only != "full") {
    std::stringstream names(only);
    for (std::string name; std::getline(names, name, ',');) add_extra(e, random, v, name);
    return e;
  }
  for (const auto& [name, draw] : catalogue_extras()) {
    if (random.chance(name == "ground_effect" ? 0.25 : 0.15)) add_extra(e, random, v, name);
  }
  std::vector<std::string> names;
  for (const auto& [name, draw] : outside_extras()) names.push_back(name);
  const int count = random.integer(1, 2);
  for (int i = 0; i < count; ++i) {
    const auto at = names.begin() + random.integer(0, static_cast<int>(names.size()) - 1);
    add_extra(e, random, v, *at);
    names.erase(at);
  }
  return e;
}

std::vector<std::string> causes_present(const Effects& e, const Vehicle& v) {
  std::vector<std::string> names;
  const auto add = [&](bool there, const char* name) {
    if (there) names.emplace_back(name);
  };
  add(e.kd > 0, "rotor_drag");
  add(!e.C.isZero(), "parasitic_drag");
  add(e.translational, "translational_lift");
  add(e.axial, "axial_inflow");
  add(e.kf > 0, "blade_flapping");
  add(e.ground_radius > 0, "ground_effect");
  add(!e.wind_W.isZero(), "wind");
  add(e.sag_exponent > 0, "battery_sag");
  add(v.lag_down > 1.01 * v.lag_up, "motor_asymmetry");
  add(v.latency > 0, "motor_delay");
  add(true, "gyroscopic");
  for (const auto& name : e.extra) {
    if (name != "ground_effect") names.push_back(name);
  }
  return names;
}

bool outside_catalogue(const std::string& cause) { return outside_extras().contains(cause); }

}  // namespace field
