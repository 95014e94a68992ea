// Assigns colours by the meaning of a name: first, second and third axis, rotor number, thrust and torque.
#include "ident/report/channel_colour.h"

#include <algorithm>
#include <array>
#include <map>

namespace ident {
namespace {

constexpr std::array<std::string_view, 11> kFirst{"p",   "x",    "ax",  "vx",     "Fx",     "Mx",
                                                  "phi", "roll", "Jxx", "thrust", "spin-up"};
constexpr std::array<std::string_view, 11> kSecond{"q",     "y",     "ay",  "vy",     "Fy",       "My",
                                                   "theta", "pitch", "Jyy", "torque", "spin-down"};
constexpr std::array<std::string_view, 10> kThird{"r",  "z",   "az",  "vz",  "Fz",
                                                  "Mz", "psi", "yaw", "Jzz", "voltage"};

int known_colour(const std::string& channel) {
  if (std::ranges::count(kFirst, channel) > 0) return 0;
  if (std::ranges::count(kSecond, channel) > 0) return 1;
  if (std::ranges::count(kThird, channel) > 0) return 2;
  const auto digits = channel.find_first_of("0123456789");
  const std::string stem = channel.substr(0, digits);
  if (digits == std::string::npos || channel.find_first_not_of("0123456789", digits) != std::string::npos)
    return -1;
  if (channel.size() - digits > 2) return -1;
  for (const char* rotor : {"rotor", "rotor ", "omega", "Omega", "Omega_", "u", "delta", "motor", "motor "})
    if (stem == rotor) return (std::stoi(channel.substr(digits)) + kColours - 1) % kColours;
  return -1;
}

}  // namespace

std::string channel_of(std::string_view series_name) {
  for (const std::string_view ending : {"measured", "predicted", "simulated", "residual", "band"}) {
    if (!series_name.ends_with(ending)) continue;
    const std::string_view stem = series_name.substr(0, series_name.size() - ending.size());
    const auto last = stem.find_last_not_of(" ,:(");
    if (last != std::string_view::npos && last + 1 < stem.size())
      return std::string(stem.substr(0, last + 1));
  }
  return std::string(series_name);
}

std::vector<int> channel_colours(const std::vector<Series>& series) {
  std::map<std::string, int> by_channel;
  std::array<bool, kColours> taken{};
  for (const Series& s : series) {
    const int known = known_colour(channel_of(s.name));
    if (known < 0) continue;
    by_channel[channel_of(s.name)] = known;
    taken[static_cast<std::size_t>(known)] = true;
  }
  std::vector<int> colours;
  int next = 0;
  for (const Series& s : series) {
    if (s.style == Series::Style::measured) {  // grey
      colours.push_back(0);
      continue;
    }
    const auto [at, is_new] = by_channel.try_emplace(channel_of(s.name), 0);
    if (is_new) {
      while (next < kColours && taken[static_cast<std::size_t>(next)]) ++next;
      at->second = next++ % kColours;
    }
    colours.push_back(at->second);
  }
  return colours;
}

}  // namespace ident
