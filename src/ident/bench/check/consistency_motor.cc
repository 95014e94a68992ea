// Do the constants of a DC motor belong together?
//
// In SI units the torque constant ki and the back-EMF constant kv are the same number but for losses and the
// shape of the windings' field: P_air gap = ki I Omega = kv Omega I.
#include "ident/bench/check/consistency_motor.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/core/format_number.h"

namespace ident {
namespace {

void check_twins(const Vehicle& vehicle, Consistency& found) {
  const std::string what = "torque and back-EMF constant";
  if (!vehicle.has("ki") || !vehicle.has("kv")) return;
  const double ki = vehicle.value("ki"), kv = vehicle.value("kv");
  if (!(ki > 0.0) || !(kv > 0.0)) return;  // said by check_values
  const double ratio = ki / kv;
  const std::string text = fmt::format("ki/kv = {}", format_number(ratio, 3));
  if (ratio > 3.0 || ratio < 1.0 / 3.0)
    return found.violated(what, {"motor_constants",
                                 text + ": in N m/A and V s/rad they are nearly equal (kv in rpm/V?)",
                                 {{"ki", ki}, {"kv", kv}}});
  if (ratio > 1.3 || ratio < 0.6)
    return found.doubtful(what, {"motor_constants", text + ", 0.8 to 1.1 is usual"});
  found.ok(what, text);
}

/// Rotor and motor cannot follow faster than the command is held, nor be slower than the vehicle.
void check_dynamics(const Vehicle& vehicle, Consistency& found) {
  if (!vehicle.has("omega_m") || !vehicle.has("zeta_m") || !(vehicle.value("omega_m") > 0.0)) return;
  const double rise = 2.0 * vehicle.value("zeta_m") / vehicle.value("omega_m");
  const std::string text = fmt::format("time constant {} s", format_number(rise, 3));
  if (rise > 1.0)
    return found.doubtful("motor dynamics", {"slow_motor", text + ": no controller hovers with that"});
  found.ok("motor dynamics", text);
}

}  // namespace

void check_motor(const Vehicle& vehicle, Consistency& found) {
  check_twins(vehicle, found);
  check_dynamics(vehicle, found);
}

}  // namespace ident
