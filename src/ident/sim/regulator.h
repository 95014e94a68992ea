// Linear-quadratic regulator about hover: the linear model of a vehicle between two commands, and the gain.
//
//   state  z = (x, v in the heading frame; small rotation of the body; w; Omega, Omega' of each rotor;
//               commands that are still under way because of the dead time)
//   z_next = A z + B delta,   delta = -K z minimises  sum z'Qz + delta'R delta
//
// K comes from the discrete Riccati equation by the structure-preserving doubling of Chu, Fan and Lin (2004).
// Motor lag, dead time, sampling and gyroscopic coupling are in the model, so the bandwidth follows them.
#pragma once

#include <Eigen/Core>

#include "ident/sim/trim.h"

namespace ident {

/// Deviations from hover, from one command to the next.
struct LinearModel {
  Eigen::MatrixXd A, B;
  int delayed = 0;  ///< past commands in the state, latest first
};

/// Linearises the plant at its trim; `interval` from command to command, s.
LinearModel hover_model(const Plant& plant, const Trim& trim, double height, double interval);

/// The gain K for weights on the deviations as they suit small vehicles: 0.4 m, 1 m/s, 0.2 rad, 3 rad/s,
/// against 0.15 of the command.
Eigen::MatrixXd regulator_gain(const LinearModel& model, int rotors);

}  // namespace ident
