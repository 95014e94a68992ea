// Sizes of kT, kQ, CT and figure of merit against what propellers have.
#include "ident/bench/thrust/thrust_sweep_plausible.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/bench/thrust/thrust_sweep_rotor.h"
#include "ident/core/format_number.h"

namespace ident {
namespace {

// Propellers from 15 mm to 1 m with a factor of ten to spare.
constexpr double kSmallest_kT = 1e-10, kLargest_kT = 1e-1;
// CT of [Phang 10] on the propellers of the UIUC data base: 0.005 to 0.03.
constexpr double kSmallestCT = 0.003, kLargestCT = 0.06;
constexpr const char* kCauses =
    "check the units of speed, thrust and torque, the order of the columns and the poles";

const Parameter* known(const Result& result, const char* name) {
  const Parameter* p = result.find(name);
  return p && p->identifiable && p->value > 0.0 ? p : nullptr;
}

void about_ignorance(Result& result, const char* name, const char* force) {
  const Parameter* p = result.find(name);
  if (!p || p->identifiable) return;
  result.warn(
      "not_identifiable",
      fmt::format("{} is not known to 10 %: {} hardly follows the rotor speed in these data, or scatters too "
                  "much. More rows, a wider range of speeds or rows at rest would tell it",
                  name, force));
}

void about_thrust(Result& result) {
  const Parameter *kT = known(result, "kT"), *CT = known(result, "CT");
  if (kT && (kT->value < kSmallest_kT || kT->value > kLargest_kT))
    result.warn("implausible_thrust", fmt::format("kT = {} N s^2/rad^2 is that of no propeller: {}",
                                                  format_number(kT->value, 3), kCauses));
  else if (CT && (CT->value < kSmallestCT || CT->value > kLargestCT))
    result.warn("implausible_thrust", fmt::format("CT = {}, and propellers have {} to {}: {}, and the radius",
                                                  format_number(CT->value, 3), format_number(kSmallestCT),
                                                  format_number(kLargestCT), kCauses));
}

void about_torque(Result& result, const ThrustOptions& options) {
  const Parameter *kT = known(result, "kT"), *kQ = known(result, "kQ"),
                  *merit = known(result, "figure_of_merit");
  if (!kT || !kQ) return;
  const double lever = kQ->value / kT->value;
  const LeverRange range = plausible_lever(options.radius);
  if (lever < range.low || lever > range.high)
    result.warn("implausible_torque_ratio",
                fmt::format("kQ/kT = {} m, and {} to {} m is plausible: {}", format_number(lever, 3),
                            format_number(range.low, 2), format_number(range.high, 2), kCauses));
  if (merit && merit->value >= 1.0)
    result.warn(
        "figure_of_merit",
        fmt::format("figure of merit {}: more thrust than momentum theory allows; check the radius, the "
                    "pole count and the units",
                    format_number(merit->value, 3)));
}

}  // namespace

void warn_of_implausible(Result& result, const ThrustOptions& options) {
  about_ignorance(result, "kT", "thrust");
  about_ignorance(result, "kQ", "torque");
  about_thrust(result);
  about_torque(result, options);
}

}  // namespace ident
