// The steady hover of a vehicle as it is: rotor speeds and attitude at which nothing accelerates, and the
// linear map from squared rotor speeds to accelerations there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/sim/plant.h"

namespace ident {

/// Hover at a height, heading north. With more than four rotors the one with the least differences.
struct Trim {
  std::vector<double> Omega;  ///< rad/s
  std::vector<double> delta;  ///< command that holds them
  Vec4<double> q_WB;          ///< tilted where the sum of forces is not along body z
  Vec3<double> up_B;          ///< direction of the total force in the body, opposite to gravity
  Eigen::Matrix<double, 4, Eigen::Dynamic>
      effect;  ///< of Omega_n^2 on w_B' (three rows) and on the lift along up_B
  double Omega_least = 0.0, Omega_most = 0.0;  ///< range of the commands 0.03 and 1, rad/s
};

/// Throws UsageError where the vehicle cannot hover, with the reason.
Trim hover_trim(const Plant& plant, double height);

}  // namespace ident
