// Typical sizes of base constants and, by their unit, of effects' constants.
#include "ident/effects/typical_scale.h"

#include <cmath>

#include "ident/effects/catalogue.h"

namespace ident {

double typical_scale(int index, const Vehicle& vehicle, const std::vector<double>& p) {
  const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  const double J = (at(param::Jxx) + at(param::Jyy)) / 2;
  const double hover =
      std::sqrt(at(param::m) * vehicle.g / (static_cast<double>(vehicle.rotors.size()) * at(param::kT)));
  switch (index) {
    case param::Jxy:
    case param::Jxz:
    case param::Jyz:
      return 0.02 * J;
    case param::Jp:
      return 0.01 * J;
    case param::alpha:
      return 0.02;
    case param::dead_time:
      return 0.005;
    case param::Omega_0:
      return 0.1 * hover;
    case param::Kdx:
    case param::Kdy:
    case param::Kdz:
      return 0.1 * at(param::m);
    default:
      break;
  }
  // Effects: the size that gives about 1 % of weight (forces) or a like moment, whatever the vehicle's mass.
  for (const EffectEntry& e : catalogue()) {
    const int k = index - e.offset;
    if (k < 0 || k >= static_cast<int>(e.parameters.size())) continue;
    const EffectParameter& q = e.parameters[static_cast<std::size_t>(k)];
    const double m = at(param::m) / 0.5, size = std::cbrt(m), speed = hover / 450.0;
    if (q.unit == "kg/rad") return q.typical * m / speed;
    if (q.unit == "N s^2/rad") return q.typical * m * size / speed;
    if (q.unit == "kg" || q.unit == "kg/m" || q.unit == "N s^2/m^2") return q.typical * m;
    if (q.unit == "kg m^2") return 0.01 * J;
    if (q.unit == "m") return q.typical * size;
    if (q.unit == "m^2") return q.typical * size * size;
    return q.typical;
  }
  return std::max(std::abs(at(index)), 1e-12);
}

}  // namespace ident
