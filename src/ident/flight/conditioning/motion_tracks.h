// What one sensor says of a motion beside what another says of it: running turns and velocities of an arc.
#pragma once

#include "ident/flight/conditioning/windowed_changes.h"

namespace ident {

/// The running turn about the body axes as the attitude shows it, rad.
Track3 turn_of_attitude(const FlightArc& arc);
/// The same as the integral of the rates.
Track3 turn_of_rates(const FlightArc& arc);
/// Velocity and position in the world, as read off the measurements.
Track3 velocity_W(const FlightArc& arc);
Track3 position_W(const FlightArc& arc);
/// The running change of velocity that specific force, attitude and gravity make, m/s.
Track3 velocity_of_force(const FlightArc& arc, double gravity);
/// The specific force in the body; zero where it was not sampled at all.
Track3 specific_force(const FlightArc& arc);
/// The integrals of three tracks over the arc's time.
Track3 integrals(const FlightArc& arc, const Track3& y);

}  // namespace ident
