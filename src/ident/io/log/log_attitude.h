// Attitude of a flight log, from a quaternion or from Euler angles.
#pragma once

#include <array>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/data/table.h"
#include "ident/io/log/frames.h"

namespace ident {

/// Unit quaternions, scalar first, without jumps of sign; in the file's frames. A quaternion goes before
/// Euler angles. An attitude that lacks a component is left out with warning `attitude_incomplete`; rows
/// whose quaternion is far from a unit one are not sampled (warning `quaternion_norm`).
std::array<std::vector<double>, 4> take_attitude(const NumberTable& table, FlightLog& log);

/// Turns the attitude into our frames.
void turn_attitude(FlightLog& log, BodyFrame body, WorldFrame world);

}  // namespace ident
