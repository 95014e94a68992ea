// Writes the vehicle file by hand: geometry and base parameters with their standard deviations.
#include "known_before.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace withheld {

KnownBefore draw_known_before(const Vehicle& v, Random& random) {
  const std::map<std::string, double> relative = {{"m", 0.002},
                                                  {"kT", random.uniform(0.02, 0.05)},
                                                  {"kQ", random.uniform(0.02, 0.05)},
                                                  {"km", 0.03},
                                                  {"omega_m", 0.1},
                                                  {"zeta_m", 0.1},
                                                  {"Jxx", 0.05},
                                                  {"Jyy", 0.05},
                                                  {"Jzz", 0.05}};
  KnownBefore known;
  for (const std::string& name : base_parameter_names()) {
    const double truth = base_parameter(v, name), std = truth * relative.at(name);
    known[name] = {truth + std * std::clamp(random.normal(), -2.5, 2.5), std};
  }
  return known;
}

void make_wrong(const Vehicle& v, const Member& member, double size, KnownBefore* known) {
  Stated& stated = known->at(member.wrong_parameter);
  const double truth = base_parameter(v, member.wrong_parameter), share = stated.std / stated.value;
  stated.value = truth * std::exp(member.wrong_reach * size);
  stated.std = share * stated.value;
}

std::string vehicle_yaml(const Vehicle& v, const KnownBefore& known, const std::string& name) {
  std::ostringstream out;
  out.precision(10);
  const auto stated = [&](const std::string& parameter) {
    const Stated& s = known.at(parameter);
    std::ostringstream text;
    text.precision(8);
    text << "{value: " << s.value << ", std: " << s.std << "}";
    return text.str();
  };
  out << "name: " << name << "\ngravity: " << v.gravity << "\nmass: " << stated("m") << "\n";
  out << "command: {min: " << v.pulse_min << ", max: " << v.pulse_max << "}\n";
  if (v.short_form) {
    out << "layout: " << v.layout << "\narm: " << v.arm << "\n";
    if (v.layout == "4sp") out << "slant_deg: " << v.slant * 180 / M_PI << "\n";
  } else {
    out << "rotors:\n";
    for (const Rotor& rotor : v.rotors) {
      const auto& r = rotor.r;
      const auto& a = rotor.a;
      out << "  - {position: [" << r.x() << ", " << r.y() << ", " << r.z() << "], axis: [" << a.x() << ", "
          << a.y() << ", " << a.z() << "], spin: " << (rotor.s > 0 ? "ccw" : "cw") << "}\n";
    }
  }
  out << "propeller_radius: " << v.radius << "\nair_density: " << v.air_density << "\nparameters:\n";
  for (const std::string& parameter : base_parameter_names()) {
    if (parameter != "m") out << "  " << parameter << ": " << stated(parameter) << "\n";
  }
  return out.str();
}

}  // namespace withheld
