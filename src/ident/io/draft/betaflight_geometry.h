// Where the motors of a Betaflight quadrotor sit, and which way they turn as its flight tells.
#pragma once

#include "ident/io/draft/frame_geometry.h"

namespace ident {

/// Quad X in Betaflight's order: rear right, front right, rear left, front left. The header does not say
/// whether the propellers turn inwards at the front (the default) or outwards: the yaw that the motors cause
/// decides, where it is plain. Throws DataError for another number of motors.
FrameGeometry betaflight_geometry(const LogStreams& log);

/// Correlation of the yaw acceleration with the motors' yaw command, if they turned as by default: near 1
/// they do, near -1 they turn the other way; 0 where there is no such flight.
double default_spin_correlation(const LogStreams& log);

}  // namespace ident
