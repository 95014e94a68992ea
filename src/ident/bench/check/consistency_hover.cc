// Can the vehicle hover: enough thrust, a command within its range, and a trim that balances all moments?
//
//   thrust to weight = sum_n T_n(delta = 1) (-a_n,z)/(m g) ,  T_n = kT (Omega_0 + km)^2 (1) trim:  T of least
//   norm with  sum_n wrench_n T_n = (0, -m g) in (Mx, My, Mz; Fz)                          (2) hover speed
//   sqrt(T_n/kT), hover command (Omega - Omega_0)/km of the rotor that works hardest             (3)
#include "ident/bench/check/consistency_hover.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/core/format_number.h"

namespace ident {
namespace {

constexpr double kLittleMargin = 1.3;  ///< below this thrust to weight there is nothing left to steer with

double at_least(const Vehicle& vehicle, const std::string& name) {
  return vehicle.has(name) ? vehicle.value(name) : 0.0;
}

/// Vertical force and moments for 1 N on each rotor: three, or without kQ roll and pitch alone.
Eigen::MatrixXd balance(const Vehicle& vehicle) {
  return rotor_wrenches(vehicle, slant_angle(vehicle)).middleRows(2, vehicle.has("kQ") ? 4 : 3);
}

/// (2), and speed and command from it.
void check_trim(const Vehicle& vehicle, double weight, Consistency& found) {
  const std::string what = "hover trim";
  const Eigen::MatrixXd B = balance(vehicle);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(B);
  const Eigen::VectorXd wanted = -weight * Eigen::VectorXd::Unit(B.rows(), 0);
  const Eigen::VectorXd T = solver.solve(wanted);
  const double left = (B * T - wanted).norm() / weight;
  if (left > 1e-6)
    return found.violated(what, {"no_hover_trim",
                                 fmt::format("no thrusts of these rotors balance weight and all {} moments",
                                             B.rows() == 4 ? "three" : "tilting"),
                                 {{"unbalanced_over_weight", left}}});
  const Eigen::Index N = B.cols();
  if (T.minCoeff() <= 0.0) {
    Eigen::Index rotor = 0;
    const double lowest = T.minCoeff(&rotor);
    return found.violated(what, {"no_hover_trim",
                                 fmt::format("to balance all moments rotor {} would have to pull with {} N",
                                             rotor + 1, format_number(lowest)),
                                 {{"rotor", rotor + 1}, {"thrust", lowest}}});
  }
  const double kT = vehicle.value("kT");
  const double mean_speed = (T / kT).cwiseSqrt().sum() / static_cast<double>(N);
  const double top_speed = std::sqrt(T.maxCoeff() / kT);
  found.extra["hover_rotor_speed"] = mean_speed;
  if (!vehicle.has("km"))
    return found.ok(what, fmt::format("{} rad/s on average, {} at most", format_number(mean_speed),
                                      format_number(top_speed)));
  const double Omega_0 = at_least(vehicle, "Omega_0"), km = vehicle.value("km");
  const double command = (mean_speed - Omega_0) / km, top_command = (top_speed - Omega_0) / km;  // (3)
  found.extra["hover_command"] = command;
  const std::string numbers =
      fmt::format("{} rad/s, command {}", format_number(mean_speed), format_number(command));
  const nlohmann::ordered_json values = {
      {"hover_command", command}, {"hardest_rotor_command", top_command}, {"hover_rotor_speed", mean_speed}};
  if (top_command > 1.0 || top_command < 0.0)
    return found.violated(what, {"hover_command_out_of_range",
                                 fmt::format("hover needs command {} ({} rad/s), outside 0 to 1",
                                             format_number(command), format_number(mean_speed)),
                                 values});
  found.ok(what, numbers);
}

/// (1)
void check_thrust(const Vehicle& vehicle, double weight, Consistency& found) {
  const std::string what = "thrust to weight";
  if (!vehicle.has("km") || !(vehicle.value("km") > 0.0))
    return found.cannot_be_judged(what, "km, the speed at full command");
  const double Omega = at_least(vehicle, "Omega_0") + vehicle.value("km");
  const double full = vehicle.value("kT") * Omega * Omega;
  const double ratio = -balance(vehicle).row(0).sum() * full / weight;
  found.extra["thrust_to_weight"] = ratio;
  const std::string text =
      fmt::format("at full command the rotors lift {} of the weight", format_number(ratio));
  if (ratio < 1.0)
    return found.violated(
        what, {"cannot_hover",
               text,
               {{"thrust_to_weight", ratio}, {"full_thrust_per_rotor", full}, {"weight", weight}}});
  if (ratio < kLittleMargin) return found.doubtful(what, {"little_thrust_margin", text});
  found.ok(what, format_number(ratio));
}

}  // namespace

void check_hover(const Vehicle& vehicle, Consistency& found) {
  const bool has_mass = vehicle.has("m") && vehicle.value("m") > 0.0;
  const bool has_thrust = vehicle.has("kT") && vehicle.value("kT") > 0.0;
  if (vehicle.rotors.empty() || !has_mass || !has_thrust || !(vehicle.g > 0.0))
    return found.cannot_be_judged("hover", "rotors, mass and kT");
  const double weight = vehicle.value("m") * vehicle.g;
  check_thrust(vehicle, weight, found);
  if (!vehicle.has("kQ")) found.cannot_be_judged("yaw at hover", "kQ");
  check_trim(vehicle, weight, found);
}

}  // namespace ident
