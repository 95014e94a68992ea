// Says that thrust does not carry the weight, and what is not known then.
#include "ident/flight/checks/mean_thrust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/flight/checks/implausible_estimates.h"

namespace ident {
void warn_of_steady_push(Result& result, const SteadyPush& push, std::span<const FlightLog> logs,
                         double gravity) {
  if (!push.matters(gravity)) return;
  const std::string where =
      push.log ? "of " + logs[static_cast<std::size_t>(*push.log)].file : std::string("of these logs");
  result.warn(
      "thrust_level",
      fmt::format(
          "In the mean {} the fitted rotors lift {:.0f} % {} than the vehicle felt, and no gust lasts that "
          "long. Constants of thrust and inertia are not identifiable. The thrust curve, the battery or a "
          "stated constant is wrong, or the model lacks an effect: weigh the vehicle and run `ident gap`.",
          where, 100 * std::abs(push.mean) / gravity, push.mean > 0 ? "more" : "less"));
  constexpr const char* kWhy = "thrust as fitted is not what the vehicle felt";
  doubt_all(result, {"m", "kT", "km", "Omega_0", "kQ", "Jp", "Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz"}, kWhy);
  // Where that much is missing, nothing that the fit says of the motors is theirs.
  constexpr double kMuchThrust = 0.2;  // of the weight
  if (std::abs(push.mean) > kMuchThrust * gravity)
    doubt_all(result, {"omega_m", "zeta_m", "dead_time"}, kWhy);
}

}  // namespace ident
