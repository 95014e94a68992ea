// How much the air moves, as a vehicle or campaign file states it: `air: light`.
//
//   light, moderate, strong: Dryden's low-altitude turbulence at 6 m (20 ft) [MIL-F-8785C, 3.7.3.4;
//   MIL-HDBK-1797], with a wind W20 of 15, 30 and 45 kt there:
//     sigma_w = 0.1 W20 ,  sigma_u = sigma_v = sigma_w/(0.177 + 0.000823 h)^0.4 ,  h in ft
//
// The standard calls the third level severe. Below the first one it has none: calm and indoors are ours.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace ident {

enum class AirLevel { indoors, calm, light, moderate, strong };

inline constexpr std::array<std::string_view, 5> kAirWords = {"indoors", "calm", "light", "moderate",
                                                              "strong"};
inline constexpr AirLevel kUnstatedAir = AirLevel::light;

inline std::string_view word_of(AirLevel level) { return kAirWords[static_cast<std::size_t>(level)]; }
/// The level of a word, nothing where it names none.
std::optional<AirLevel> air_level(std::string_view word);

/// Gusts of a level: standard deviations, m/s.
struct GustScale {
  double horizontal = 0.0, vertical = 0.0;
};
GustScale gusts_of(AirLevel level);

}  // namespace ident
