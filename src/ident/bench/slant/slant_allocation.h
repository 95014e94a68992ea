// What a rotor's thrust does to the body, in all six channels, and the four inputs of a slanted quadrotor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ident/model/vehicle.h"

namespace ident {

/// Force and moment about the centre of gravity: Fx, Fy, Fz, Mx, My, Mz in the body frame.
using ChannelVector = Eigen::Matrix<double, 6, 1>;
constexpr std::array<const char*, 6> kChannels = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

/// Column n: force (N) and moment (N m) at rest for kT Omega_n^2 = 1 N on rotor n alone, at a slant angle.
/// What the vehicle states of its rotors and its centre of gravity counts: rotor_mismatch, rotor_tilt,
/// cg_offset. Needs kT > 0; mass and inertia play no part.
Eigen::Matrix<double, 6, Eigen::Dynamic> rotor_wrenches(const Vehicle& vehicle, double alpha);

/// The inputs in the order of their rows and columns.
constexpr std::array<const char*, 4> kInputs = {"heave", "roll", "pitch", "yaw"};

/// Share of each rotor in the four inputs of [Phang, Theorem 4.1], in vertical thrust: heave {1,1,1,1}, roll
/// {0,1,0,-1}, pitch {1,0,-1,0}, yaw {1,-1,1,-1} for front, left, back, right.
Eigen::MatrixXd input_shares(const std::vector<Rotor>& rotors);

/// Are these four rotors in a plus that all turn the same way: a quadrotor that a slant can balance?
bool is_slantable(const std::vector<Rotor>& rotors);

/// The rotors with the direction of slant filled in where none has one: that of their axis where it is
/// tilted, else the two lateral ones turn about their arms, against the torque of the others.
std::vector<Rotor> with_slant_directions(std::vector<Rotor> rotors);

/// Columns: the four inputs, each 1 N of vertical thrust on the rotors it moves up. Rows: channels.
Eigen::Matrix<double, 6, 4> input_allocation(const Vehicle& vehicle, double alpha);

}  // namespace ident
