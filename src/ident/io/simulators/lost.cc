// Compares a vehicle with what a simulator's file holds of it; an effect says itself what will be missing.
#include "ident/io/simulators/lost.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

std::string size_of(const Vehicle& v, const std::string& name) {
  const std::string unit = parameter_unit(name);
  return fmt::format("{} {:.4g}{}", name, v.value(name), unit == "-" || unit.empty() ? "" : " " + unit);
}

/// Sizes of the parameters of an effect that the vehicle has off their null values.
std::string stated(const Vehicle& v, const EffectEntry& e) {
  std::string out;
  for (const EffectParameter& p : e.parameters) {
    const std::string name = fmt::format("{}.{}", e.info.name, p.name);
    if (v.has(name) && v.value(name) != p.null_value) out += (out.empty() ? "" : ", ") + size_of(v, name);
  }
  return out;
}

bool folded(const EffectEntry& e, const Capacity& holds) {
  const std::string_view name = e.info.name;
  if (name == "rotor_tilt") return holds.tilted_axes;
  if (name == "rotor_mismatch") return holds.each_rotor;
  if (name == "gyroscopic") return holds.rotor_momentum;
  if (name == "cg_offset") return holds.centre != Capacity::Centre::none;
  if (name == "products_of_inertia") return holds.products;
  if (name == "motor_asymmetry") return holds.up_and_down;
  return name == "payload" || name == "motor_delay";  // what of these is lost is said of the constants
}

void lost_effects(const Vehicle& v, const Capacity& holds, std::vector<std::string>& out) {
  for (const EffectEntry& e : catalogue()) {
    const std::string sizes = stated(v, e);
    if (sizes.empty() || folded(e, holds)) continue;
    bool all_kept = true;
    for (const EffectParameter& p : e.parameters) {
      const std::string name = fmt::format("{}.{}", e.info.name, p.name);
      const bool is_held = holds.constants.contains(name) || holds.replaced.contains(name);
      all_kept = all_kept && (is_held || !v.has(name) || v.value(name) == p.null_value);
    }
    if (!all_kept)
      out.push_back(fmt::format("{} is left out ({}): the simulation will lack {}", e.info.name, sizes,
                                e.info.looks_like));
  }
}

void lost_of_the_body(const Vehicle& v, const Capacity& holds, std::vector<std::string>& out) {
  const MassProperties body = mass_properties(v);
  const bool curved =
      holds.constants.contains("thrust_curve.c") && !stated(v, entry(EffectId::thrust_curve)).empty();
  if (curved && body.m != v.value("m"))
    out.push_back(
        fmt::format("the thrust curve is taken about hover with {:.4g} kg, and was stated about hover with "
                    "{:.4g} kg: refine it with the mass as it flies",
                    body.m, v.value("m")));
  if (!holds.products && !body.J.isDiagonal(0.0))
    out.push_back(fmt::format(
        "products of inertia are left out (Jxy {:.4g}, Jxz {:.4g}, Jyz {:.4g} kg m^2): axes will not "
        "couple at high frequency",
        body.J(0, 1), body.J(0, 2), body.J(1, 2)));
  if (holds.centre == Capacity::Centre::none && !body.c_B.isZero(0.0))
    out.push_back(fmt::format(
        "the centre of gravity is put at the origin (it is at [{:.4g}, {:.4g}, {:.4g}] m): the trim "
        "moments will be missing",
        body.c_B.x(), body.c_B.y(), body.c_B.z()));
  if (!holds.rotor_momentum && body.Jp != 0.0)
    out.push_back(
        fmt::format("the rotors have no inertia there (Jp {:.4g} kg m^2): yaw will not lead with the rotors' "
                    "acceleration, and roll and pitch will not couple through their momentum",
                    body.Jp));
}

void lost_of_the_motor(const Vehicle& v, const Capacity& holds, std::vector<std::string>& out) {
  const MotorLags lags = motor_lags(v);
  if (holds.motor == Capacity::Motor::instant && lags.up + lags.dead_time > 0)
    out.push_back(fmt::format(
        "the motors follow at once there: {:.3g} ms of lag are missing, and the simulated vehicle is "
        "easier to control",
        1e3 * (lags.up + lags.dead_time)));
  if (holds.motor != Capacity::Motor::first_order || !(lags.up > 0)) return;
  if (v.has("zeta_m") && !is_first_order(v))
    out.push_back(fmt::format(
        "the motor of second order (omega_m {:.4g} rad/s, zeta_m {:.3g}) becomes one of first order "
        "with the same mean delay of {:.3g} ms",
        v.value("omega_m"), v.value("zeta_m"), 1e3 * lags.up));
  if (!holds.dead_time && lags.dead_time > 0)
    out.push_back(
        fmt::format("the dead time of {:.3g} ms is added to the time constant", 1e3 * lags.dead_time));
}

void lost_of_the_rotors(const Vehicle& v, const Capacity& holds, std::vector<std::string>& out) {
  const auto upright = [&](const Rotor& r) {
    return axis_at(r, slant_angle(v)).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12);
  };
  if (!holds.tilted_axes && !std::ranges::all_of(v.rotors, upright))
    out.push_back("thrust axes are made upright: lateral force and part of the yaw moment will be missing");
  if (!holds.heights && std::ranges::any_of(v.rotors, [](const Rotor& r) { return r.r_B.z() != 0.0; }))
    out.push_back(
        "hubs are put at the height of the centre of gravity: drag of the rotors makes no moment there");
  if (!holds.idle_speed && v.has("Omega_0") && v.value("Omega_0") != 0.0)
    out.push_back(fmt::format(
        "Omega_0 {:.4g} rad/s is left out: the speed at full command is kept, that at small commands "
        "is wrong",
        v.value("Omega_0")));
  for (const char* name : {"Kdx", "Kdy", "Kdz"})
    if (v.has(name) && v.value(name) != 0.0 && !holds.constants.contains(name) &&
        !holds.replaced.contains(name))
      out.push_back(fmt::format("the linear drag {} is left out", size_of(v, name)));
}

}  // namespace

std::vector<std::string> lost(const Vehicle& vehicle, const Capacity& holds, std::string_view target) {
  std::vector<std::string> out;
  if (holds.everything) return out;
  lost_effects(vehicle, holds, out);
  lost_of_the_body(vehicle, holds, out);
  lost_of_the_motor(vehicle, holds, out);
  lost_of_the_rotors(vehicle, holds, out);
  if (vehicle.signs == Signs::as_published && !holds.as_published)
    out.push_back(fmt::format("the printed signs of the reaction torque are not those of {}", target));
  return out;
}

}  // namespace ident
