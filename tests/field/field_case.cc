// Draws a case from its seed; one that does not fly is drawn again.
#include "field_case.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace field {
namespace {

bool indoors(Random& random, const Vehicle& v) { return v.m < 0.1 || random.chance(0.25); }

FlightLimits draw_limits(Random& random, const Vehicle& v, bool inside, bool low) {
  FlightLimits limits;
  limits.speed = inside ? random.uniform(1.2, 2.5) : random.uniform(4, 11);
  limits.climb = inside ? 1.0 : random.uniform(2, 4);
  limits.sink = inside ? 0.8 : random.uniform(1, 2.5);
  limits.room = inside ? random.uniform(1.5, 3) : random.uniform(6, 14);
  limits.height = inside ? 1.5 : low ? random.uniform(2, 3) : random.uniform(8, 25);
  if (low) limits.low = random.uniform(1.5, 2.5) * v.radius + (inside ? 0.05 : 0.25);
  limits.tilt = random.uniform(0.2, 0.45);
  return limits;
}

std::string draw_air(Random& random, bool inside, bool low) {
  if (inside) return "indoors";
  if (low) return "calm";
  return random.pick<const char*>({"calm", "calm", "light", "light", "moderate"});
}

Vector3d draw_wind(Random& random, const std::string& air) {
  if (air == "indoors" || !random.chance(0.6)) return Vector3d::Zero();
  const double speed = random.uniform(0.3, 1) * (air == "calm" ? 0.8 : air == "light" ? 4 : 7);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return {speed * std::cos(angle), speed * std::sin(angle), 0};
}

// Off by so much that naming the constant is right.
constexpr double kOff = 0.05;

bool off(const Case& c, const std::string& name, double share = kOff) {
  if (!c.stated.states(name)) return false;
  const Constant& s = c.stated.constants.at(name);
  return std::abs(s.value - s.truth) > share * std::abs(s.truth);
}

// Sizes of effects in the catalogue's form. Where the law here is another one, 20 % to either side.
void add_effects(const Case& c, std::map<std::string, Range>& ranges) {
  const auto point = [&](const std::string& name, double value) { ranges[name] = {value, value}; };
  const auto about = [&](const char* name, double value) { ranges[name] = {0.8 * value, 1.2 * value}; };
  about("axial_inflow.kz", effective_kz(c.v, c.e));
  about("ground_effect.radius", c.e.ground_radius);
  point("blade_flapping.kf", c.e.kf);
  ranges["parasitic_drag.C"] = {c.e.C.minCoeff(), c.e.C.maxCoeff()};
  const char* const axes[] = {"x", "y", "z"};
  const char* const pairs[] = {"Jxy", "Jxz", "Jyz"};
  for (int i = 0; i < 3; ++i) {
    point(std::string("cg_offset.") + axes[i], c.e.c_B[i]);
    point(std::string("products_of_inertia.") + pairs[i], c.e.products[i]);
  }
}

}  // namespace

Case draw_case(std::uint64_t seed, std::uint64_t index, const std::string& only) {
  Case c{.seed = seed, .index = index, .only = only};
  c.plain = only == "plain" || (only.empty() && index % 5 == 0);
  Random of_vehicle(seed, index, "vehicle"), of_effects(seed, index, "effects"),
      of_flight(seed, index, "flight");
  c.v = draw_vehicle(of_vehicle);
  if (c.plain) c.v.lag_up = c.v.lag_down = c.v.lag();
  c.e = draw_effects(of_effects, c.v, c.plain, only);
  const bool inside = indoors(of_flight, c.v), low = c.e.ground_radius > 0;
  const std::string air = draw_air(of_flight, inside, low);
  if (!c.plain) c.e.wind_W = draw_wind(of_flight, air);
  Random of_statement(seed, index, "statement"), of_tuning(seed, index, "tuning");
  c.stated = draw_statement(of_statement, c.v, c.e, c.plain, air);
  c.tuning = draw_tuning(of_tuning, c.v);
  Random of_instruments(seed, index, "instruments");
  c.instruments = draw_instruments(of_instruments, c.v, c.plain);
  if (c.plain && c.stated.sag) c.instruments.voltage = true;  // a stated law of the voltage needs the voltage
  const FlightLimits limits = draw_limits(of_flight, c.v, inside, low);
  const double share = of_flight.uniform(0.5, 1.0);
  double charge = of_flight.uniform(0.8, 0.97);
  for (size_t i = 0; i < 3; ++i) {
    c.settings[i] = {.air = air_level(air),
                     .gust_share = share,
                     .duration = std::round(of_flight.uniform(25, 60)),
                     .charge = charge,
                     .style = static_cast<int>(i),
                     .limits = limits};
    charge -= of_flight.uniform(0.1, 0.25);
  }
  return c;
}

void fly_case(Case& c) {
  for (size_t i = 0; i < 3; ++i) {
    const Stated* stated = i < 2 ? &c.stated : nullptr;
    c.flights[i] = fly(c.v, c.e, c.tuning, c.instruments, c.settings[i], stated,
                       Random(c.seed, c.index, "log" + std::to_string(i + 1)));
  }
}

std::set<std::string> outside_present(const Case& c) {
  std::set<std::string> names;
  for (const auto& name : causes_present(c.e, c.v)) {
    if (outside_catalogue(name)) names.insert(name);
  }
  return names;
}

std::set<std::string> names_present(const Case& c) {
  std::set<std::string> names;
  for (const auto& name : causes_present(c.e, c.v)) {
    if (!outside_catalogue(name)) names.insert(name);
  }
  if (c.stated.drag) names.erase("rotor_drag");
  if (c.stated.sag) names.erase("battery_sag");
  if (c.stated.states("dead_time")) names.erase("motor_delay");
  if (c.stated.states("Jp")) names.erase("gyroscopic");
  for (const auto& [name, constant] : c.stated.constants) {
    if (!off(c, name)) continue;
    names.insert("parameter:" + (name == "lag" ? std::string("omega_m") : name));
  }
  return names;
}

std::set<std::string> names_implied(const Case& c) {
  std::set<std::string> names;
  const auto add = [&](bool implied, std::initializer_list<const char*> list) {
    if (implied) names.insert(list.begin(), list.end());
  };
  const Instruments& in = c.instruments;
  const bool late = in.gyro_delay() > 0.002 || in.outside_delay > 0 || in.speed_delay > 0.002;
  add(c.e.tilt > 0 && !c.stated.drag, {"rotor_drag"});  // a thrust that tilts back is drag of this form
  add(c.stated.drag && c.e.tilt > 0, {"parameter:rotor_drag.kd"});
  add(c.settings[0].air.across >= 0.3 && !c.plain, {"wind"});  // the mean of gusts over a flight
  add(late, {"sensor_delay", "motor_delay", "parameter:dead_time"});
  add(c.v.latency > 0 || late, {"parameter:dead_time"});
  add(c.v.lag_down > 1.1 * c.v.lag_up || c.stated.second_order, {"parameter:omega_m", "parameter:zeta_m"});
  add(c.e.sag_exponent > 0 && !c.stated.sag, {"parameter:km"});
  add(c.e.sag_exponent > 0 && c.e.sag_exponent < 0.95, {"parameter:battery_sag.n"});
  add(c.v.Omega_0 > 0 && !c.stated.states("Omega_0"), {"parameter:km", "parameter:Omega_0", "thrust_curve"});
  // No flight tells mass, kT and km apart; inertia is known over kT.
  add(off(c, "kT") || off(c, "m", 0.02) || off(c, "km"), {"parameter:kT", "parameter:m", "parameter:km"});
  add(off(c, "kT"), {"parameter:Jxx", "parameter:Jyy", "parameter:Jzz", "parameter:kQ"});
  add(off(c, "m", 0.01) || !c.e.c_B.isZero(), {"payload"});
  add(!c.e.c_B.isZero(), {"imu_lever_arm"});  // sensors sit at the origin, not at the centre of gravity
  for (const auto& name : names_present(c)) names.erase(name);
  return names;
}

std::map<std::string, Range> true_ranges(const Case& c) {
  std::map<std::string, Range> ranges;
  const auto point = [&](const char* name, double value) { ranges[name] = {value, value}; };
  const double mean = c.e.weak_rotor < 0 ? 1 : 1 - (1 - c.e.weak_ratio) / c.v.rotors();
  point("m", c.v.m);
  ranges["kT"] = {mean * c.v.kT, c.v.kT};
  ranges["kQ"] = {mean * c.v.kQ, c.v.kQ};
  double least = 1, most = 1;
  if (c.e.sag_exponent > 0 && !c.stated.sag) {
    const auto gain = [&](double voltage) {
      return std::pow(voltage / c.v.battery.reference, c.e.sag_exponent);
    };
    const auto& f = c.flights;
    most = gain(std::max(f[0].voltage_first, f[1].voltage_first));
    least = gain(std::min(f[0].voltage_last, f[1].voltage_last));
    if (!c.stated.reference_voltage) most = std::max(most, 1.0);
  }
  const double hover = (c.v.hover_speed() - c.v.Omega_0) / c.v.km;
  const double offset = c.stated.states("Omega_0") ? 0 : c.v.Omega_0 / hover;
  ranges["km"] = {least * c.v.km, most * (c.v.km + offset)};
  if (c.stated.states("Omega_0") || c.v.Omega_0 > 0)
    ranges["Omega_0"] = {least * c.v.Omega_0, most * c.v.Omega_0};
  ranges["lag"] = {c.v.lag_up, c.v.lag_down};
  ranges["dead_time"] = {c.v.latency, c.v.latency + c.instruments.gyro_delay()};
  point("Jxx", c.v.J.x());
  point("Jyy", c.v.J.y());
  point("Jzz", c.v.J.z());
  point("Jp", c.v.Jp);
  ranges["rotor_drag.kd"] = {c.e.kd, effective_kd(c.v, c.e)};
  point("battery_sag.n", c.e.sag_exponent);
  add_effects(c, ranges);
  return ranges;
}

}  // namespace field
