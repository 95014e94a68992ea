// Do thrust and torque constant belong to a propeller of that size?
//
//   figure of merit = T^1.5/sqrt(2 rho A)/(Q Omega) = kT^1.5/(kQ sqrt(2 rho A)) < 1   momentum theory (1)
#include "ident/bench/check/consistency_rotor.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ident/bench/thrust/thrust_sweep_rotor.h"
#include "ident/core/format_number.h"

namespace ident {
namespace {

constexpr double kSeaLevelDensity = 1.225;  // kg/m^3, where the file states none
constexpr double kSoundSpeed = 340.0;       // m/s
constexpr double kTipMach = 0.9;            // above it a static test shows drag divergence

void check_lever(const Vehicle& vehicle, double lever, Consistency& found) {
  const std::string what = "torque against thrust";
  const bool sized = vehicle.propeller_radius.has_value();
  const double unit = sized ? *vehicle.propeller_radius : 1.0, ratio = lever / unit;
  const LeverRange range = plausible_lever(vehicle.propeller_radius);
  const double low = range.low / unit, high = range.high / unit;
  const std::string text =
      sized ? fmt::format("kQ/kT = {} m is {} propeller radii", format_number(lever), format_number(ratio, 3))
            : fmt::format("kQ/kT = {} m", format_number(lever));
  if (ratio >= low && ratio <= high) return found.ok(what, text);
  found.violated(what,
                 {"implausible_torque_ratio",
                  text + fmt::format("; {} to {} is plausible", format_number(low), format_number(high)),
                  {{"kQ_over_kT", lever}, {"ratio", ratio}}});
}

void check_figure_of_merit(const Vehicle& vehicle, double kT, double kQ, Consistency& found) {
  const std::string what = "figure of merit";
  if (!vehicle.propeller_radius) return found.cannot_be_judged(what, "propeller_radius");
  const double rho = vehicle.air_density.value_or(kSeaLevelDensity);
  const double merit = figure_of_merit(kT, kQ, *vehicle.propeller_radius, rho);
  found.extra["figure_of_merit"] = merit;
  const std::string text = fmt::format("figure of merit {}", format_number(merit, 3));
  const nlohmann::ordered_json values = {{"figure_of_merit", merit},
                                         {"kT", kT},
                                         {"kQ", kQ},
                                         {"propeller_radius", *vehicle.propeller_radius},
                                         {"air_density", rho}};
  if (merit >= 1.0)
    return found.violated(what, {"figure_of_merit",
                                 text + ": more thrust than momentum theory allows for this torque", values});
  if (merit < 0.2 || merit > 0.85)
    return found.doubtful(what, {"figure_of_merit", text + " (0.4 to 0.75 is usual)"});
  found.ok(what, text);
}

void check_tip_speed(const Vehicle& vehicle, Consistency& found) {
  const std::string what = "tip speed";
  if (!vehicle.has("km") || !vehicle.propeller_radius) return;
  const double Omega = vehicle.value("km") + (vehicle.has("Omega_0") ? vehicle.value("Omega_0") : 0.0);
  const double mach = Omega * *vehicle.propeller_radius / kSoundSpeed;
  const std::string text = fmt::format("Mach {} at full command", format_number(mach, 3));
  if (mach < kTipMach) return found.ok(what, text);
  found.violated(what, {"tip_speed",
                        "blade tips reach " + text,
                        {{"mach", mach}, {"Omega", Omega}, {"propeller_radius", *vehicle.propeller_radius}}});
}

void check_overlap(const Vehicle& vehicle, Consistency& found) {
  if (!vehicle.propeller_radius) return;
  for (std::size_t a = 0; a < vehicle.rotors.size(); ++a)
    for (std::size_t b = a + 1; b < vehicle.rotors.size(); ++b) {
      const Eigen::Vector3d between = vehicle.rotors[b].r_B - vehicle.rotors[a].r_B;
      const bool stacked = std::fabs(between.z()) > 0.1 * *vehicle.propeller_radius;
      if (stacked || between.norm() >= 2.0 * *vehicle.propeller_radius) continue;
      return found.doubtful("room for the propellers",
                            {"rotors_overlap", fmt::format("rotors {} and {} are {} m apart and {} m wide",
                                                           a + 1, b + 1, format_number(between.norm()),
                                                           format_number(2.0 * *vehicle.propeller_radius))});
    }
}

}  // namespace

void check_rotor(const Vehicle& vehicle, Consistency& found) {
  check_tip_speed(vehicle, found);
  check_overlap(vehicle, found);
  if (!vehicle.has("kT") || !vehicle.has("kQ"))
    return found.cannot_be_judged("torque against thrust", "kT and kQ");
  const double kT = vehicle.value("kT"), kQ = vehicle.value("kQ");
  if (!(kT > 0.0) || !(kQ > 0.0)) return;  // said by check_values
  check_lever(vehicle, kQ / kT, found);
  check_figure_of_merit(vehicle, kT, kQ, found);
}

}  // namespace ident
