// Marks what depends on the motors' lag where their commands hold vibration.
#include "ident/flight/checks/vibration_in_commands.h"

#include "ident/flight/checks/implausible_estimates.h"

namespace ident {

void doubt_passed_on(Result& result, const Vibration& vibration) {
  if (vibration.passed_on)
    doubt_all(result, {"omega_m", "zeta_m", "dead_time", "Jp"},
              "the controller passes vibration on to the motors");
}

}  // namespace ident
