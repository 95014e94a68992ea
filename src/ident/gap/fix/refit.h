// Constants of a simulator's model that make up for what its file cannot hold.
//
// The file holds a model R of the vehicle M that was identified. Along the flown motion R is to accelerate
// as M does: over windows i of measured flight,
//
//   min over u:  sum |dv_R(u) - dv_M|_i^2/s^2 + |u|^2                                                   (14)
//
// with dv what the forces of a model give over a window, s a hundredth of what the vehicle itself gained, and
// u the constants of R about their plain values. Nothing changes where R is M. Moments stay as they are: see
// gap/README.md.
#pragma once

#include <span>

#include "ident/data/flight_log.h"
#include "ident/model/vehicle.h"

namespace ident {

/// The vehicle that a file holds, `held`, with constants by (14) from the flight of these logs; `held` where
/// the logs tell nothing of it.
Vehicle refitted(const Vehicle& held, const Vehicle& identified, std::span<const FlightLog> logs);

}  // namespace ident
