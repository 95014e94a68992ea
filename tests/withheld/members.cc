// The list of all that may be withheld: the catalogue, wrong parameters, and what lies outside.
#include "members.h"

#include <set>
#include <stdexcept>

namespace withheld {

const std::vector<std::string>& catalogue_names() {
  static const std::vector<std::string> names = {
      "rotor_drag",    "parasitic_drag", "translational_lift", "axial_inflow",        "blade_flapping",
      "ground_effect", "wind",           "battery_sag",        "motor_delay",         "motor_asymmetry",
      "thrust_curve",  "rotor_mismatch", "rotor_tilt",         "gyroscopic",          "cg_offset",
      "payload",       "imu_bias",       "imu_lever_arm",      "products_of_inertia", "imu_misalignment",
      "sensor_delay"};
  return names;
}

const std::vector<std::string>& outside_names() {
  static const std::vector<std::string> names = {
      "slung_load", "slosh", "flexible_arms", "blade_imbalance", "vortex_ring", "downwash", "backlash"};
  return names;
}

const std::vector<std::string>& wrong_parameter_names() {
  static const std::vector<std::string> names = {"parameter:kT",      "parameter:kQ",     "parameter:km",
                                                 "parameter:omega_m", "parameter:zeta_m", "parameter:Jxx",
                                                 "parameter:Jyy",     "parameter:Jzz",    "parameter:m"};
  return names;
}

bool acts_before_rotor_speed(const std::string& name) {
  static const std::set<std::string> names = {"battery_sag", "motor_delay",       "motor_asymmetry",
                                              "backlash",    "parameter:omega_m", "parameter:zeta_m",
                                              "parameter:km"};
  return names.contains(name);
}

bool draw_wrong_parameter(const std::string& name, Random& random, Member* member) {
  const std::string prefix = "parameter:";
  if (name.rfind(prefix, 0) != 0) return false;
  const std::string parameter = name.substr(prefix.size());
  static const std::map<std::string, double> reach = {{"kT", 0.3},      {"kQ", 0.6},     {"km", 0.25},
                                                      {"omega_m", 1.3}, {"zeta_m", 1.2}, {"Jxx", 0.6},
                                                      {"Jyy", 0.6},     {"Jzz", 0.6},    {"m", 0.25}};
  member->wrong_parameter = parameter;
  member->wrong_reach = reach.at(parameter) * random.sign();
  return true;
}

Member draw_member(const std::string& name, const Vehicle& vehicle, Random& random) {
  Member member;
  member.name = name;
  if (draw_air_member(name, vehicle, random, &member) || draw_drive_member(name, vehicle, random, &member) ||
      draw_body_member(name, vehicle, random, &member) ||
      draw_sensor_member(name, vehicle, random, &member) ||
      draw_outside_member(name, vehicle, random, &member) || draw_wrong_parameter(name, random, &member)) {
    return member;
  }
  throw std::invalid_argument("no effect is called " + name);
}

}  // namespace withheld
