// Folds effects through the model's own seams, so that no equation of an effect is written twice.
#include "ident/io/simulators/reduced.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/io/simulators/value.h"

namespace ident {
namespace {

using Eigen::Vector3d;

/// Whether an effect enters a seam.
template <class Seam>
bool enters(EffectId id) {
  bool found = false;
#define IDENT_EFFECT(file, Type)                                                 \
  if constexpr (requires(const double* p, Seam& seam) { Type::apply(p, seam); }) \
    found = found || id == EffectId::file;
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  return found;
}

std::vector<double> lenient_parameters(const Vehicle& vehicle) {
  std::vector<double> p = null_parameters();
  for (const ParameterInfo& info : all_parameters())
    if (vehicle.has(info.name)) p[static_cast<std::size_t>(info.index)] = vehicle.value(info.name);
  return p;
}

/// The seam after all effects of the vehicle.
template <class Seam>
Seam with_effects(const Vehicle& vehicle, Seam seam) {
  const std::vector<double> p = lenient_parameters(vehicle);
  EffectSet<double>(p, active_effects(p)).apply(seam);
  return seam;
}

void erase_effect(Vehicle& vehicle, std::string_view effect) {
  std::erase_if(vehicle.parameters, [&](const auto& entry) {
    return entry.first.size() > effect.size() && entry.first.starts_with(effect) &&
           entry.first[effect.size()] == '.';
  });
}

template <class Seam>
void erase_entering(Vehicle& vehicle) {
  for (const EffectEntry& e : catalogue())
    if (enters<Seam>(e.id)) erase_effect(vehicle, e.info.name);
}

void state(Vehicle& vehicle, const std::string& name, double value, double absent) {
  value = as_stated(value);
  if (value == absent)
    vehicle.parameters.erase(name);
  else
    vehicle.parameters[name] = {value, {}};
}

RotorSeam<double> rotor_at_rest(const Vehicle& vehicle, std::size_t n, double T) {
  static const double one = 1.0;
  RotorSeam<double> seam;
  seam.index = static_cast<int>(n), seam.per_Omega_hover = &one, seam.Omega = 1.0, seam.height = 1e9;
  seam.v_air_B = seam.F_B = seam.M_B = Vec3<double>(0, 0, 0);
  const Vector3d a = axis_at(vehicle.rotors[n], slant_angle(vehicle));
  seam.a_B = Vec3<double>(a.x(), a.y(), a.z()), seam.T = seam.Q = T;
  return seam;
}

Vector3d mounted_axis(const Vehicle& vehicle, std::size_t n) {
  const RotorSeam<double> seam = with_effects(vehicle, rotor_at_rest(vehicle, n, 1.0));
  return Vector3d(seam.a_B[0], seam.a_B[1], seam.a_B[2]).normalized();
}

/// The rotors in the order of the only layout that a target has.
std::vector<Rotor> ordered(const Vehicle& vehicle, const std::vector<FixedRotor>& layout,
                           std::string_view target, std::vector<std::size_t>& order) {
  const auto refuse = [&](const std::string& what) {
    throw UsageError(fmt::format("{}: {} {}", vehicle.file.empty() ? "vehicle" : vehicle.file, target, what));
  };
  if (vehicle.rotors.size() != layout.size())
    refuse(fmt::format("holds {} rotors, the vehicle has {}", layout.size(), vehicle.rotors.size()));
  std::vector<Rotor> rotors;
  int reversed = 0;
  for (const FixedRotor& place : layout) {
    const auto fits = [&](const Rotor& r) { return r.r_B.x() * place.x > 0 && r.r_B.y() * place.y > 0; };
    const auto at = std::ranges::find_if(vehicle.rotors, fits);
    if (at == vehicle.rotors.end()) refuse("holds an X layout only: no rotor in each quadrant");
    order.push_back(static_cast<std::size_t>(at - vehicle.rotors.begin()));
    rotors.push_back(*at);
    reversed += at->s != place.spin ? 1 : 0;
  }
  if (reversed != 0 && reversed != static_cast<int>(layout.size()))
    refuse("holds spins that alternate around the vehicle only");
  return rotors;
}

/// X layout: mean distances, since that is all that such a file holds.
void even_out(std::vector<Rotor>& rotors) {
  double x = 0, y = 0, z = 0;
  const double n = static_cast<double>(rotors.size());
  for (const Rotor& r : rotors)
    x += std::abs(r.r_B.x()) / n, y += std::abs(r.r_B.y()) / n, z += r.r_B.z() / n;
  for (Rotor& r : rotors)
    r.r_B = {as_stated(std::copysign(x, r.r_B.x())), as_stated(std::copysign(y, r.r_B.y())), as_stated(z)};
}

void reduce_rotors(const Vehicle& whole, const Capacity& holds, std::string_view target, Vehicle& v) {
  std::vector<double> ratios;
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    v.rotors[n].a_B = holds.tilted_axes ? mounted_axis(whole, n) : Vector3d(-Vector3d::UnitZ());
    v.rotors[n].a_B = v.rotors[n].a_B.unaryExpr(&as_stated).eval();
    v.rotors[n].slant_B.setZero();
    ratios.push_back(rotor_ratio(whole, n));
  }
  v.layout.clear(), v.arm.reset();
  v.parameters.erase("alpha"), v.parameters.erase("l");
  erase_effect(v, "rotor_tilt"), erase_effect(v, "rotor_mismatch");
  const MassProperties body = mass_properties(whole);
  if (holds.centre == Capacity::Centre::by_positions)
    for (Rotor& r : v.rotors) r.r_B -= body.c_B;
  if (!holds.heights)
    for (Rotor& r : v.rotors) r.r_B.z() = 0.0;
  std::vector<std::size_t> order;
  if (!holds.layout.empty()) {
    v.rotors = ordered(v, holds.layout, target, order);
    even_out(v.rotors);
  }
  for (std::size_t n = 0; n < v.rotors.size(); ++n) {
    v.rotors[n].r_B = v.rotors[n].r_B.unaryExpr(&as_stated).eval();
    const double ratio = ratios[order.empty() ? n : order[n]];
    if (holds.each_rotor && n < 8) state(v, fmt::format("rotor_mismatch.ratio@{}", n + 1), ratio, 1.0);
  }
}

void reduce_body(const Vehicle& whole, const Capacity& holds, Vehicle& v) {
  MassProperties body = mass_properties(whole);
  erase_entering<MassSeam<double>>(v);
  if (holds.centre != Capacity::Centre::own) body.c_B.setZero();
  if (!holds.products) body.J = Eigen::Matrix3d(body.J.diagonal().asDiagonal());
  if (!holds.rotor_momentum) body.Jp = 0.0;
  body.Jp = std::max(body.Jp, holds.least_momentum * body.J(2, 2));
  set_mass_properties(v, body);
}

void reduce_motor(const Vehicle& whole, const Capacity& holds, Vehicle& v) {
  MotorLags lags = motor_lags(whole);
  erase_entering<TimeSeam<double>>(v);
  v.parameters.erase("dead_time");
  if (holds.dead_time)
    state(v, "dead_time", lags.dead_time, 0.0);
  else
    lags.up += lags.dead_time, lags.down += lags.dead_time;
  if (!holds.up_and_down) lags.down = lags.up;
  if (holds.motor == Capacity::Motor::instant) lags.up = lags.down = 0.0;
  if (holds.motor != Capacity::Motor::full) set_first_order(v, lags.up, lags.down);
  if (holds.motor == Capacity::Motor::full && !holds.up_and_down) erase_effect(v, "motor_asymmetry");
  if (!holds.idle_speed && v.has("Omega_0")) {  // the speed at full command counts
    state(v, "km", full_speed(whole), 0.0);
    v.parameters.erase("Omega_0");
  }
}

bool kept(const std::string& name, const Capacity& holds) {
  static const std::set<std::string_view> always = {"m",
                                                    "Jxx",
                                                    "Jyy",
                                                    "Jzz",
                                                    "Jxy",
                                                    "Jxz",
                                                    "Jyz",
                                                    "Jp",
                                                    "kT",
                                                    "kQ",
                                                    "km",
                                                    "Omega_0",
                                                    "omega_m",
                                                    "zeta_m",
                                                    "dead_time",
                                                    "cg_offset.x",
                                                    "cg_offset.y",
                                                    "cg_offset.z",
                                                    "motor_asymmetry.ratio"};
  return always.contains(name) || holds.constants.contains(name) || name.starts_with("rotor_mismatch.ratio@");
}

}  // namespace

MotorLags motor_lags(const Vehicle& vehicle) {
  const DriveSeam<double> drive = with_effects(vehicle, DriveSeam<double>{0.0, 1.0, false, 1.0, 1.0});
  const double delay = vehicle.has("dead_time") ? vehicle.value("dead_time") : 0.0;
  MotorLags lags{.dead_time = with_effects(vehicle, TimeSeam<double>{delay, 0.0}).command_delay};
  if (!vehicle.has("omega_m") || !(vehicle.value("omega_m") > 0)) return lags;
  lags.up = 2 * vehicle.value("zeta_m") / vehicle.value("omega_m");
  lags.down = lags.up / drive.down_ratio;
  return lags;
}

void set_first_order(Vehicle& vehicle, double up, double down) {
  for (const char* name : {"omega_m", "zeta_m", "motor_asymmetry.ratio"}) vehicle.parameters.erase(name);
  if (!(up > 0)) return;
  vehicle.parameters["zeta_m"] = {kFirstOrderDamping, {}};
  vehicle.parameters["omega_m"] = {as_stated(2 * kFirstOrderDamping / up), {}};
  if (down > 0) state(vehicle, "motor_asymmetry.ratio", up / down, 1.0);
}

MassProperties mass_properties(const Vehicle& vehicle) {
  const auto get = [&](const char* name) { return vehicle.has(name) ? vehicle.value(name) : 0.0; };
  MassSeam<double> seam{get("m"), {}, Vec3<double>(0, 0, 0), get("Jp")};
  seam.J << get("Jxx"), get("Jxy"), get("Jxz"), get("Jxy"), get("Jyy"), get("Jyz"), get("Jxz"), get("Jyz"),
      get("Jzz");
  seam = with_effects(vehicle, seam);
  return {seam.m, seam.Jp, seam.J, {seam.c_B[0], seam.c_B[1], seam.c_B[2]}};
}

void set_mass_properties(Vehicle& v, const MassProperties& body) {
  // What sums over parts leave of a zero: no product below 1e-13 of the trace, no centre below a femtometre.
  const auto product = [&](double x) { return std::abs(x) < 1e-13 * body.J.trace() ? 0.0 : x; };
  const auto length = [](double x) { return std::abs(x) < 1e-15 ? 0.0 : x; };
  state(v, "m", body.m, 0.0);
  state(v, "Jxx", body.J(0, 0), 0.0), state(v, "Jyy", body.J(1, 1), 0.0), state(v, "Jzz", body.J(2, 2), 0.0);
  state(v, "Jxy", product(body.J(0, 1)), 0.0), state(v, "Jxz", product(body.J(0, 2)), 0.0),
      state(v, "Jyz", product(body.J(1, 2)), 0.0);
  state(v, "Jp", body.Jp, 0.0);
  state(v, "cg_offset.x", length(body.c_B.x()), 0.0), state(v, "cg_offset.y", length(body.c_B.y()), 0.0);
  state(v, "cg_offset.z", length(body.c_B.z()), 0.0);
}

double rotor_ratio(const Vehicle& vehicle, std::size_t rotor) {
  const std::string name = fmt::format("rotor_mismatch.ratio@{}", rotor + 1);
  return vehicle.has(name) ? vehicle.value(name) : 1.0;
}

double hover_speed(const Vehicle& v) {
  return std::sqrt(v.value("m") * v.g / (static_cast<double>(v.rotors.size()) * v.value("kT")));
}

double full_speed(const Vehicle& v) {
  return (v.has("km") ? v.value("km") : 0.0) + (v.has("Omega_0") ? v.value("Omega_0") : 0.0);
}

Vehicle reduced(const Vehicle& vehicle, const Capacity& holds, std::string_view target) {
  const std::string file = vehicle.file.empty() ? "vehicle" : vehicle.file;
  for (const char* name : {"m", "kT", "kQ", "Jxx", "Jyy", "Jzz"})
    if (!vehicle.has(name) || !(vehicle.value(name) > 0))
      throw UsageError(fmt::format("{}: {}: a positive value is needed to export a model", file,
                                   std::string_view(name) == "m" ? "mass" : name));
  for (const char* name : holds.needs)
    if (!vehicle.has(name) || !(vehicle.value(name) > 0))
      throw UsageError(fmt::format("{}: {}: a positive value is needed to export to {}", file, name, target));
  if (vehicle.rotors.empty())
    throw UsageError(file + ": rotors: an export needs them, or a layout with an arm");
  Vehicle v = vehicle;
  v.correlation = {}, v.warnings.clear();
  for (auto& [name, known] : v.parameters) known.std.reset();
  if (holds.everything) return v;
  reduce_rotors(vehicle, holds, target, v);
  reduce_body(vehicle, holds, v);
  reduce_motor(vehicle, holds, v);
  std::erase_if(v.parameters, [&](const auto& entry) { return !kept(entry.first, holds); });
  for (auto& [name, known] : v.parameters) known.value = as_stated(known.value);
  if (!holds.as_published) v.signs = Signs::first_principles;
  if (!holds.ground) v.ground_z = 0.0;
  if (!holds.air_density) v.air_density.reset();
  if (!holds.battery) v.battery_voltage.reset();
  return v;
}

}  // namespace ident
