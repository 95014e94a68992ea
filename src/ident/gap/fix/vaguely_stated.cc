// Deviations for constants that a fit frees anyway.
#include "ident/gap/fix/vaguely_stated.h"

#include <algorithm>

#include "ident/effects/all_parameters.h"
#include "ident/flight/smoother/parameterisation.h"
#include "ident/io/simulators/reduced.h"

namespace ident {
namespace {

// Of itself by which a constant of a simulator's file is off, a standard deviation. [-] Of one vehicle,
// others publish Jxx of 1.03, 1.40 and 1.66e-5 kg m^2 (data/REAL_FLIGHT.md): a quarter; and thrust is off as
// much.
constexpr double kVague = 0.3;
constexpr double kHeld = 1e-3;  // the same of a zeta_m that only stands for a lag of first order

}  // namespace

Vehicle vaguely_stated(Vehicle vehicle) {
  const auto has_deviation = [](const auto& entry) { return entry.second.std.has_value(); };
  if (std::ranges::any_of(vehicle.parameters, has_deviation)) return vehicle;
  for (const FreeConstant& c : free_constants(vehicle, parameter_vector(vehicle), {})) {
    const auto at = vehicle.parameters.find(c.name);
    if (at == vehicle.parameters.end() || !(at->second.value > 0)) continue;
    const bool held = c.index == param::zeta_m && is_first_order(vehicle);
    at->second.std = (held ? kHeld : kVague) * at->second.value;
  }
  return vehicle;
}

}  // namespace ident
