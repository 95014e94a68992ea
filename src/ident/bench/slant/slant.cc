// Result of `ident slant`.
#include "ident/bench/slant/slant.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/bench/slant/slant_optimum.h"
#include "ident/bench/slant/slant_tables.h"
#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/model/arm_length.h"

namespace ident {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Known needed(const Vehicle& vehicle, const std::string& name, const std::string& meaning) {
  if (!vehicle.has(name))
    throw InputError(vehicle.file, 0, "parameters." + name,
                     "is missing: the slant angle needs " + meaning + " (run `ident thrust` first)");
  const Known known = vehicle.parameters.at(name);
  if (!(known.value > 0.0)) throw InputError(vehicle.file, 0, "parameters." + name, "has to be positive");
  return known;
}

Known needed_arm(const Vehicle& vehicle) {
  if (const std::optional<Known> arm = arm_length(vehicle)) return *arm;
  throw InputError(vehicle.file, 0, "arm", "is missing: the slant angle needs the distance of the hubs");
}

/// Angle at which the lateral rotors are mounted; NaN where the file states none (a layout without
/// `slant_deg` asks for the angle, it is not one mounted at 0).
double mounted_angle(const Vehicle& vehicle) {
  double sum = 0.0;
  int slanted = 0;
  for (const Rotor& rotor : vehicle.rotors) {
    const double level = rotor.a_B.head<2>().norm();
    if (level < 1e-3 && (rotor.slant_B.isZero() || !vehicle.has("alpha"))) continue;
    sum += std::atan2(rotor.slant_B.isZero() ? level : rotor.slant_B.dot(rotor.a_B), -rotor.a_B.z());
    ++slanted;
  }
  return slanted ? sum / slanted : kNaN;
}

/// The quadrotor that is judged: this one where its rotors allow it, else one with its arm and propellers.
Vehicle judged(Vehicle vehicle, double arm, Result& result) {
  if (is_slantable(vehicle.rotors)) {
    vehicle.rotors = with_slant_directions(vehicle.rotors);
    return vehicle;
  }
  if (!vehicle.rotors.empty())
    result.warn(
        "not_4sp",
        "these rotors are no plus of four that turn the same way: the angle is that of a 4SP with the "
        "same propellers and arm, which this vehicle does not need");
  vehicle.rotors = layout_rotors("4sp", arm, 0.0);
  return vehicle;
}

Parameter angle_parameter(double alpha, double std) {
  Parameter p{.name = "alpha_opt", .value = alpha, .std = std, .unit = "rad", .source = "slant"};
  // Symmetric in log(tan(alpha)), as the three constants are known by their relative errors.
  const double x = std::tan(alpha), half = normal_quantile(0.975) * std * (1.0 + x * x) / x;
  p.ci95 = {std::atan(x * std::exp(-half)), std::atan(x * std::exp(half))};
  p.identifiable = std < 0.1 * alpha;
  if (!std::isfinite(std)) p.note = "kT or kQ has no standard deviation";
  return p;
}

void add_mounted(Result& result, const Vehicle& vehicle, double arm, double best) {
  const double mounted = mounted_angle(vehicle);
  if (!std::isfinite(mounted)) return;
  const SlantPrice price = slant_price(vehicle, arm, mounted);
  const double trim = -price.yaw_leak / price.yaw_authority;  // infinite for upright rotors: null in JSON
  result.extra["mounted"] = {{"alpha", mounted}, {"alpha_deg", mounted / kDegree}, {"yaw_trim", trim}};
  if (std::fabs(mounted - best) <= 0.2 * kDegree) return;
  const std::string needs =
      std::fabs(trim) < 1.0
          ? fmt::format("hover needs {:.1f} % of the hover thrust as yaw input", 100.0 * std::fabs(trim))
          : "no yaw input holds its heading at hover";
  result.warn("slant_not_optimal", fmt::format("mounted at {:.2f} deg, best is {:.2f} deg: {}",
                                               mounted / kDegree, best / kDegree, needs));
}

Section section(const Vehicle& vehicle, double arm, double alpha, double best) {
  const SlantPrice price = slant_price(vehicle, arm, alpha);
  const double trim = mounting_trim(vehicle, arm, alpha, kDegree);
  Table costs{.title = "Price", .columns = {"quantity", "value"}};
  costs.rows = {
      {"thrust of a slanted rotor over its lift", format_number(price.lift, 6)},
      {"yaw moment of the yaw input over l t", format_number(price.yaw_authority)},
      {"sideways force of the roll input over t", format_number(price.sideways)},
      {"yaw input that 1 deg of mounting error costs, of hover thrust",
       std::isfinite(trim) ? fmt::format("{:.1f} %", 100.0 * trim) : "–"},
      {"best angle for the vehicle as it is [deg]", format_number(best / kDegree, 6)},
      {"moments left coupled there, over l t", format_number(unwanted_moment(vehicle, arm, best))},
      {"moments left coupled at alpha_opt, over l t", format_number(unwanted_moment(vehicle, arm, alpha))}};
  return {.title = "Slant angle",
          .text =
              "tan(alpha) = 2 kQ/(l kT) [Phang 24] decouples the moments of the four inputs in vertical "
              "thrust for equal rotors. The forces stay coupled: a roll input t pushes sideways with "
              "-2 t tan(alpha).",
          .tables = {allocation_table(vehicle, alpha), costs},
          .plots = slant_plots(vehicle, arm, alpha)};
}

}  // namespace

Result estimate_slant(const Vehicle& vehicle) {
  Result result{.command = "slant", .inputs = {vehicle.file}, .warnings = vehicle.warnings};
  const Known kT = needed(vehicle, "kT", "the thrust constant"),
              kQ = needed(vehicle, "kQ", "the torque constant"), arm = needed_arm(vehicle);
  const Vehicle quadrotor = judged(vehicle, arm.value, result);
  const double alpha = optimal_slant(kT.value, kQ.value, arm.value);
  const double std = optimal_slant_std(kT, kQ, arm, vehicle.correlation.of("kT", "kQ"));
  if (!std::isfinite(std))
    result.warn("no_uncertainty",
                "kT or kQ has no standard deviation, so alpha_opt has none. State them in the vehicle file, "
                "or run `ident thrust`.");
  result.parameters = {angle_parameter(alpha, std)};
  const double best = best_slant(quadrotor, arm.value);
  const SlantPrice price = slant_price(quadrotor, arm.value, alpha);
  result.extra["alpha_opt_deg"] = alpha / kDegree;
  result.extra["alpha_numerical"] = {
      {"value", best},
      {"deg", best / kDegree},
      {"unwanted_moment", unwanted_moment(quadrotor, arm.value, best)},
      {"unwanted_moment_at_alpha_opt", unwanted_moment(quadrotor, arm.value, alpha)}};
  result.extra["allocation"] = allocation_json(quadrotor, alpha);
  result.extra["price"] = {{"lift", price.lift},
                           {"yaw_authority", price.yaw_authority},
                           {"sideways_of_roll", price.sideways},
                           {"yaw_trim_per_degree", mounting_trim(quadrotor, arm.value, alpha, kDegree)}};
  add_mounted(result, quadrotor, arm.value, best);
  result.verdict = fmt::format(
      "Slant of {:.3f} deg{} decouples the moments; it costs {:.2f} % of the lift of "
      "the slanted rotors.",
      alpha / kDegree, std::isfinite(std) ? fmt::format(" ± {:.3f} deg", std / kDegree) : "",
      100.0 * (price.lift - 1.0));
  result.sections = {section(quadrotor, arm.value, alpha, best)};
  return result;
}

}  // namespace ident
