// Does the slant of a quadrotor with four equal propellers balance their torque?
#include "ident/bench/check/consistency_slant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ident/bench/slant/slant_allocation.h"
#include "ident/bench/slant/slant_optimum.h"
#include "ident/core/format_number.h"
#include "ident/model/arm_length.h"

namespace ident {

void check_slant(const Vehicle& vehicle, Consistency& found) {
  const std::string what = "slant angle";
  if (!vehicle.has("alpha") || !is_slantable(vehicle.rotors)) return;
  const std::optional<Known> arm = arm_length(vehicle);
  if (!arm || !(arm->value > 0.0) || !vehicle.has("kT") || !vehicle.has("kQ") || !(vehicle.value("kT") > 0.0))
    return found.cannot_be_judged(what, "arm, kT and kQ");
  constexpr double degree = std::numbers::pi / 180.0;
  const Known kT = vehicle.parameters.at("kT"), kQ = vehicle.parameters.at("kQ"),
              alpha = vehicle.parameters.at("alpha");
  const double best = optimal_slant(kT.value, kQ.value, arm->value);
  const std::string text =
      fmt::format("mounted at {:.2f} deg, 2 kQ/(l kT) gives {:.2f} deg", alpha.value / degree, best / degree);
  found.extra["alpha_opt"] = best;
  const double std = optimal_slant_std(kT, kQ, *arm, 0.0);
  const double spread = std::isfinite(std) ? std::hypot(std, alpha.std.value_or(0.0)) : 0.0;
  if (std::fabs(alpha.value - best) <= std::max(0.2 * degree, 2.0 * spread)) return found.ok(what, text);
  found.doubtful(what, {"slant_not_optimal", text + ": hover needs a steady yaw input"});
}

}  // namespace ident
