// What commands by themselves make an inertial sensor show, as far as the constants to start from tell.
#pragma once

#include "ident/flight/conditioning/rotor_tones.h"
#include "ident/flight/conditioning/windowed_changes.h"

namespace ident {

/// Rates (rad/s, but for what drifts) or specific force (m/s^2), by the channel group, that rotors simulated
/// from the commands of an arc would make along the body axes of a vehicle without anything else acting on
/// it; empty without commands. Where no rotor inertia is stated, a usual one counts: about the vertical it
/// does most of what is fast.
Track3 commanded_motion(const FlightRecord& record, const FlightArc& arc, int group);

/// The same of the rows of each window of a sensor, (sample, axis), without what drifts over the window, in
/// units of its noise; empty without commands.
std::vector<Eigen::MatrixXd> commanded_in(const FlightRecord& record, int group, const ToneWindows& sensor);

}  // namespace ident
