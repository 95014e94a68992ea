// What each rotor of a vehicle turns like under its commands, and the moments that it makes.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ident/flight/record/flight_record.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Speed of each rotor at the rows of an arc, simulated from its commands, rad/s.
std::vector<std::vector<double>> simulated_speeds(const FlightArc& arc, const Vehicle& vehicle,
                                                  std::span<const double> p);

/// What a rotor does about the three axes: by the integral of its squared speed, and by its speed.
struct RotorMoment {
  Eigen::Vector3d by_thrust, by_spin;
  Eigen::Vector3d per_Jp;  ///< by_spin of rotors with an inertia of one
};
std::vector<RotorMoment> rotor_moments(const Vehicle& vehicle, std::span<const double> p);

}  // namespace ident
