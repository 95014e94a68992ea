// Limits in the coordinates of the unknowns.
#include "ident/flight/ladder/constant_limits.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/catalogue.h"

namespace ident {
namespace {

// Published inertias of one vehicle differ by a third (data/REAL_FLIGHT.md), thrust per squared command by
// its battery and propellers by a factor of 2; beyond these factors the input is not what it is said to be.
constexpr double kInertiaFactor = 2.0, kRotorFactor = 3.0;
constexpr double kOffset = 5.0;      // of a command curve, in its typical sizes: half the speed of hover
constexpr double kWeighed = 5.0;     // deviations of a mass
constexpr double kMassFactor = 1.5;  // of a mass without a deviation

}  // namespace

std::array<double, 2> limits_of(const FreeConstant& c) {
  if (c.index == param::m) {
    const double part =
        c.prior_std ? std::min(kWeighed * *c.prior_std / c.prior_value, 0.5) : kMassFactor - 1;
    return {std::log1p(-part), std::log1p(part)};
  }
  if (c.positive) {
    const bool inertia = c.index == param::Jxx || c.index == param::Jyy || c.index == param::Jzz;
    const double most = std::log(inertia ? kInertiaFactor : kRotorFactor);
    return {-most, most};
  }
  const EffectParameter* of = find_effect_parameter(c.name);
  if (!of) return c.index == param::Omega_0 ? std::array{-kOffset, kOffset} : std::array{-100.0, 100.0};
  const double most = physical_limit(c), null = of->null_value;
  const double low = of->range == Range::positive ? null : null - most;
  return {(low - c.start) / c.scale, (null + most - c.start) / c.scale};
}

double spread_without_prior(const FreeConstant& c) {
  const auto [low, high] = limits_of(c);
  return std::max(std::abs(low), std::abs(high));
}

}  // namespace ident
