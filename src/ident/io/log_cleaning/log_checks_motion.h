// Rates, attitude, velocity and position against each other: units and axes.
#pragma once

#include "ident/io/log_cleaning/log_checks.h"

namespace ident {

/// Throws InputError where rates disagree with the attitude by the factor of degrees to radians;
/// `quaternions` have no unit that could be wrong.
void check_rates_against_attitude(const FlightLog& log, long header_line, bool quaternions);

/// Throws InputError where velocities are along the axes of the body. `to_body` turns what was read as along
/// those of the world to what it would be then.
void check_velocity_axes(const FlightLog& log, long header_line, const Eigen::Matrix3d& to_body);

}  // namespace ident
