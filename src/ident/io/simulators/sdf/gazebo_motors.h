// What the motor plugins of Gazebo (gz-sim and classic) have in common: one set of entries for each rotor.
#pragma once

#include <string>
#include <vector>

#include "ident/io/simulators/capacity.h"
#include "ident/io/simulators/fields.h"
#include "ident/io/simulators/value.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Names and texts in which the two differ.
struct GazeboDialect {
  std::string_view plugin;  ///< part of the plugin's file name by which it is known
  std::string_view filename, name;
  bool relative_airspeed;  ///< classic: thrust falls with the speed along the axis, T (1 - v/max)
};

Capacity gazebo_capacity(const GazeboDialect& dialect);
Vehicle gazebo_vehicle(const Fields& fields, const GazeboDialect& dialect);
/// Gravity of a world that states none; kT and kQ of the mean rotor.
void gazebo_stand_in(Vehicle& reduced);
std::vector<Value> gazebo_values(const Vehicle& vehicle, const Fields* own, const GazeboDialect& dialect);
std::vector<std::string> gazebo_remarks(const Vehicle& whole, const Vehicle& reduced,
                                        const GazeboDialect& dialect);

}  // namespace ident
