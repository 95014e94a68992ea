// Names a unit from its base unit and multiplier.
#include "ident/io/dataflash/units.h"

#include <array>
#include <cmath>

namespace ident::dataflash {
namespace {

struct Prefix {
  double factor;
  const char* letter;
};
constexpr std::array<Prefix, 5> kPrefixes = {{{1.0, ""}, {1e-2, "c"}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}}};
constexpr double kRounding = 1e-6;  // of a factor, which may be that of a float

}  // namespace

std::string Units::unit(int kind, std::size_t column, double letter_scale) const {
  const auto ids = of_kind_.find(kind);
  if (ids == of_kind_.end() || column >= ids->second.units.size()) return {};
  const auto named = units_.find(ids->second.units[column]);
  if (named == units_.end() || named->second.empty() || named->second == "UNKNOWN") return {};
  double multiplier = 1.0;
  if (column < ids->second.multipliers.size())
    if (const auto at = multipliers_.find(ids->second.multipliers[column]); at != multipliers_.end())
      multiplier = at->second;
  if (multiplier == 0.0) multiplier = 1.0;  // "no multiplier" in the table of old firmware
  const double rest = letter_scale == 1.0 ? multiplier : multiplier / letter_scale;
  for (const Prefix& prefix : kPrefixes)
    if (std::abs(rest / prefix.factor - 1.0) < kRounding) return prefix.letter + named->second;
  return {};
}

}  // namespace ident::dataflash
