// Units as they stand in headers and maps, and their factors to SI.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ident {

/// What a quantity is; a column's unit has to be one of its dimension.
enum class Dimension {
  number,        ///< no unit
  time,          ///< s
  length,        ///< m
  mass,          ///< kg
  velocity,      ///< m/s
  acceleration,  ///< m/s^2
  angle,         ///< rad
  angular_rate,  ///< rad/s
  force,         ///< N
  torque,        ///< N m
  voltage,       ///< V
  current,       ///< A
  fraction,      ///< 0 to 1; % is a hundredth
  pulse_width,   ///< us: the one quantity that is not SI inside
};

struct Unit {
  double scale = 1.0;  ///< SI value = scale * number + offset
  double offset = 0.0;
};

/// Unit of a dimension by its spelling, without case where that is unambiguous: `deg/s`, `rpm`, `N·m`, `Nm`,
/// `gf`.
std::optional<Unit> find_unit(std::string_view spelling, Dimension dimension);

/// The spellings of a dimension's units, for messages.
std::string known_units(Dimension dimension);

/// A header as name and unit: "Thrust (kgf)" is {"Thrust", "kgf"}; the unit is empty where none stands there.
struct HeaderName {
  std::string name;
  std::optional<std::string> unit;
};
HeaderName split_header(std::string_view header);

}  // namespace ident
