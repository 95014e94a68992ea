// Where the motors of a Betaflight quadrotor sit, and which way they turn, as its flight tells.
#pragma once

#include "ident/io/geometry/frame_geometry.h"

namespace ident {

/// Quad X in Betaflight's order: rear right, front right, rear left, front left. The header does not say
/// whether the propellers turn inwards at the front (the default) or outwards (`yaw_motors_reversed`): the
/// motors' answer to the yaw controller decides. Throws DataError for another number of motors.
FrameGeometry betaflight_geometry(const LogStreams& log);

/// Correlation of the yaw torque that the motors' commands would cause, if they turned as by default, with
/// the one that the yaw controller asks for: near 1 they do, near -1 they turn the other way, 0 where the log
/// does not tell. The vehicle flies, so its controller knows; what yaw does itself is no witness, because the
/// loop is closed.
double default_spin_correlation(const LogStreams& log);

}  // namespace ident
