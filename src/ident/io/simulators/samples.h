// Sets of constants drawn from what is known of a vehicle, for domain randomisation.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ident/io/simulators/simulator_format.h"

namespace ident {

/// Vehicles drawn from the standard deviations and correlations: normal, positive constants in their
/// logarithms. An inertia that no body has is drawn again. The same seed gives the same vehicles. Throws
/// DataError where the vehicle states no standard deviation, or where hardly any draw is a body.
std::vector<Vehicle> sampled_vehicles(const Vehicle& vehicle, std::size_t count, std::uint64_t seed);

/// One row a vehicle with the entries of a target under its own names: "mass", "rotor1.pose[1]".
std::string samples_csv(const SimulatorFormat& format, const std::vector<Vehicle>& vehicles,
                        std::uint64_t seed);

}  // namespace ident
