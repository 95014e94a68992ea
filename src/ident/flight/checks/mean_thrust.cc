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
          "in the mean {} the rotors as fitted lift {:.0f} % {} than the vehicle felt, and no gust lasts as "
          "long: thrust does not go with the square of the command's speed (another curve, a battery that "
          "sags), a stated constant is wrong, or the model lacks an effect (try ident gap)",
          where, 100 * std::abs(push.mean) / gravity, push.mean > 0 ? "more" : "less"));
  constexpr const char* kWhy = "thrust as fitted is not what the vehicle felt";
  doubt_all(result, {"m", "kT", "km", "Omega_0", "kQ", "Jp", "Jxx", "Jyy", "Jzz", "Jxy", "Jxz", "Jyz"}, kWhy);
  // Where that much is missing, nothing that the fit says of the motors is theirs.
  constexpr double kMuchThrust = 0.2;  // of the weight
  if (std::abs(push.mean) > kMuchThrust * gravity)
    doubt_all(result, {"omega_m", "zeta_m", "dead_time"}, kWhy);
}

}  // namespace ident
