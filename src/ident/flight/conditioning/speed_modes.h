// Measured rotor speeds of a vehicle as its input, smoothed together.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Orthogonal combinations of the rotors' speeds, one in a row: what lifts, what rolls beside that, then what
/// pitches, what yaws, and the rest.
Eigen::MatrixXd speed_modes(const Vehicle& vehicle, std::span<const double> p);

/// Speeds of all rotors [rotor][row]; `likely` and `rougher` as in SmoothedSpeed.
struct SmoothedSpeeds {
  std::vector<std::vector<double>> likely, rougher;
  SpeedErrors errors;  ///< by mode; without rows where there is no noise
};

/// Smoothed mode by mode where all rotors were sampled together, else rotor by rotor. Rotors change together
/// by far more than against each other, and those small differences turn the vehicle: smoothed rotor by rotor
/// they keep noise as large as what is smoothed away of the common motion allows, which weakens all that acts
/// through moments.
SmoothedSpeeds smoothed_speeds(const std::vector<double>& t, const std::vector<std::vector<double>>& speeds,
                               const Eigen::MatrixXd& modes);

}  // namespace ident
