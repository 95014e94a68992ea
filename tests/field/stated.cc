// Draws the errors of the stated constants and writes the vehicle file.
#include "stated.h"

#include <fstream>
#include <iomanip>
#include <stdexcept>

namespace field {
namespace {

constexpr double kFarthest = 2.2;  // stated deviations, of an honest error

Constant honest(Random& random, double truth, double relative) {
  // The deviation is stated of the value that the bench gave.
  const double value = truth * (1 + relative * random.normal_within(kFarthest));
  return {truth, value, relative * value, false};
}

double spread(Random& random) { return random.log_uniform(0.05, 0.15); }

bool possible(const Stated& s) {  // triangle inequality
  const auto J = [&](const char* name) { return s.constants.at(name).value; };
  return J("Jxx") + J("Jyy") > 1.02 * J("Jzz");
}

void draw_inertia(Random& random, const Vehicle& v, Stated& s) {
  do {
    const double relative = spread(random);
    s.constants["Jxx"] = honest(random, v.J.x(), relative);
    s.constants["Jyy"] = honest(random, v.J.y(), relative);
    s.constants["Jzz"] = honest(random, v.J.z(), relative);
  } while (!possible(s));
}

void overstate_one(Random& random, Stated& s) {
  const Stated before = s;
  do {
    s = before;
    const std::string name = random.pick<const char*>({"kT", "kQ", "km", "lag", "Jxx", "Jyy", "Jzz"});
    Constant& c = s.constants.at(name);
    c.value = c.truth * (1 + random.sign() * random.uniform(0.15, 0.30));
    c.std = c.value * random.uniform(0.03, 0.05);
    c.overconfident = true;
  } while (!possible(s));
}

}  // namespace

double effective_kd(const Vehicle& v, const Effects& e) { return e.kd + v.kT * e.tilt / v.radius; }

Stated draw_statement(Random& random, const Vehicle& v, const Effects& e, bool plain,
                      const std::string& air) {
  Stated s;
  s.air = air;
  s.constants["m"] = honest(random, v.m, random.chance(0.85) ? 0.004 : 0.02);
  s.constants["kT"] = honest(random, v.kT, spread(random));
  s.constants["kQ"] = honest(random, v.kQ, spread(random));
  s.constants["km"] = honest(random, v.km, spread(random));
  s.constants["lag"] = honest(random, v.lag(), spread(random));
  draw_inertia(random, v, s);
  if (v.Omega_0 > 0 && (plain || random.chance(0.5))) {
    s.constants["Omega_0"] = honest(random, v.Omega_0, spread(random));
  }
  if (plain || random.chance(0.5)) s.constants["Jp"] = honest(random, v.Jp, 0.15);
  if (v.latency > 0 && (plain || random.chance(0.3))) {
    s.constants["dead_time"] = {v.latency, v.latency + 5e-4 * random.normal_within(kFarthest), 5e-4, false};
  }
  s.drag = e.kd > 0 && (plain || random.chance(0.25));
  if (s.drag) s.constants["rotor_drag.kd"] = honest(random, effective_kd(v, e), spread(random));
  s.sag = e.sag_exponent > 0 && (plain || random.chance(0.3));
  s.reference_voltage = s.sag || (e.sag_exponent > 0 && random.chance(0.5));
  s.second_order = !plain && random.chance(0.3);
  if (!plain && random.chance(0.2)) overstate_one(random, s);
  return s;
}

Vehicle with_stated(Vehicle v, const std::string& name, double value) {
  if (name == "m") v.m = value;
  if (name == "kT") v.kT = value;
  if (name == "kQ") v.kQ = value;
  if (name == "km") v.km = value;
  if (name == "Omega_0") v.Omega_0 = value;
  if (name == "Jp") v.Jp = value;
  if (name == "dead_time") v.latency = value;
  if (name == "Jxx") v.J.x() = value;
  if (name == "Jyy") v.J.y() = value;
  if (name == "Jzz") v.J.z() = value;
  if (name == "lag") {
    const double scale = value / v.lag();
    v.lag_up *= scale;
    v.lag_down *= scale;
  }
  return v;
}

void write_vehicle_file(const std::string& path, const std::string& name, const Vehicle& v, const Stated& s,
                        bool pulses) {
  std::ofstream out(path);
  out << std::setprecision(6);
  const auto pair = [&](double value, double std) {
    out << "{value: " << value << ", std: " << std << "}\n";
  };
  const Constant& m = s.constants.at("m");
  out << "name: " << name << "\ngravity: " << kGravity << "\nmass: ";
  pair(m.value, m.std);
  if (pulses) out << "command: {min: 1000, max: 2000}\n";
  out << "rotors:\n";
  for (const Hub& hub : v.hubs) {
    out << "  - {position: [" << hub.r_B.x() << ", " << hub.r_B.y() << ", " << hub.r_B.z()
        << "], axis: [0, 0, -1], spin: " << (hub.s > 0 ? "ccw" : "cw") << "}\n";
  }
  out << "propeller_radius: " << v.radius << "\nair_density: " << kAirDensity << "\nair: " << s.air << "\n";
  if (s.reference_voltage) out << "battery_voltage: " << v.battery.reference << "\n";
  out << "parameters:\n";
  for (const auto& [key, c] : s.constants) {
    if (key == "m") continue;
    if (key == "lag") {
      const double factor = s.second_order ? 2 : 100;  // lag = 2 zeta_m/omega_m
      out << "  omega_m: ";
      pair(factor / c.value, factor / c.value * c.std / c.value);
      out << "  zeta_m: " << (s.second_order ? "{value: 1, std: 0.2}\n" : "{value: 50, std: 0.5}\n");
    } else {
      out << "  " << key << ": ";
      pair(c.value, c.std);
    }
  }
  if (s.sag) out << "  battery_sag.n: {value: 1, std: 0.1}\n";
  if (!out) throw std::runtime_error("cannot write " + path);
}

}  // namespace field
