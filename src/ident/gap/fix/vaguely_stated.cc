// Deviations for constants that a fit frees anyway.
#include "ident/gap/fix/vaguely_stated.h"

#include <algorithm>

namespace ident {
namespace {

// Of itself by which a constant of a simulator's file is off, a standard deviation. [-] Thrust, lag and
// inertia of published models differ from flight by up to a half.
constexpr double kVague = 0.3;
// zeta_m [-] from which it stands for a lag of first order (1000 does), and the share to which it is held.
constexpr double kFirstOrder = 100.0, kHeld = 1e-3;

}  // namespace

Vehicle vaguely_stated(Vehicle vehicle) {
  const auto has_deviation = [](const auto& entry) { return entry.second.std.has_value(); };
  if (std::ranges::any_of(vehicle.parameters, has_deviation)) return vehicle;
  for (const char* name : {"kT", "kQ", "km", "omega_m", "zeta_m", "Jxx", "Jyy", "Jzz"}) {
    const auto at = vehicle.parameters.find(name);
    if (at == vehicle.parameters.end() || !(at->second.value > 0)) continue;
    const bool held = at->first == "zeta_m" && at->second.value > kFirstOrder;
    at->second.std = (held ? kHeld : kVague) * at->second.value;
  }
  return vehicle;
}

}  // namespace ident
