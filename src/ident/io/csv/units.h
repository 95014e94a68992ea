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

/// SI value of one unit of a dimension by its spelling: `deg/s`, `rpm`, `N·m`, `Nm`, `gf`. Case counts only
/// where it has to (`mN`). Empty when that is no unit of the dimension.
std::optional<double> unit_factor(std::string_view spelling, Dimension dimension);

/// The spellings of a dimension's units, for messages.
std::string known_units(Dimension dimension);

/// A header as name and unit: "Thrust (kgf)" is {"Thrust", "kgf"}; the unit is empty where none stands there.
/// Digits in brackets right behind a name belong to it: "gyro_rad[0]".
struct HeaderName {
  std::string name;
  std::optional<std::string> unit;
};
HeaderName split_header(std::string_view header);

}  // namespace ident
