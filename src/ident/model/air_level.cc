// Dryden's low-altitude turbulence at one height, and two levels below it.
#include "ident/model/air_level.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr double kMetresPerSecondInKnot = 0.514444;
constexpr double kHeight = 20.0;  // ft
// m/s, along every axis. Rooms have mean speeds of 0.1 to 0.15 m/s and a turbulence intensity of about 40 %
// [ISO 7730, draught]. Calm is below force 1 of Beaufort's scale, 0.3 m/s.
constexpr double kIndoors = 0.05, kCalm = 0.3;

GustScale dryden(double knots) {
  const double sigma_w = 0.1 * knots * kMetresPerSecondInKnot;
  const double sigma_u = sigma_w / std::pow(0.177 + 0.000823 * kHeight, 0.4);
  return {.horizontal = sigma_u, .vertical = sigma_w};
}

}  // namespace

std::optional<AirLevel> air_level(std::string_view word) {
  const auto found = std::ranges::find(kAirWords, word);
  if (found == kAirWords.end()) return std::nullopt;
  return static_cast<AirLevel>(found - kAirWords.begin());
}

GustScale gusts_of(AirLevel level) {
  switch (level) {
    case AirLevel::indoors:
      return {kIndoors, kIndoors};
    case AirLevel::calm:
      return {kCalm, kCalm};
    case AirLevel::light:
      return dryden(15.0);
    case AirLevel::moderate:
      return dryden(30.0);
    case AirLevel::strong:
      return dryden(45.0);
  }
  return {};
}

}  // namespace ident
