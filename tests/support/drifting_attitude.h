// Logs as an estimator would show them: its attitude drifts.
#pragma once

#include "ident/core/math.h"
#include "ident/core/random.h"
#include "ident/data/flight_log.h"
#include "ident/estimators/flight_noise.h"

namespace ident::testing {

/// Turns the attitude of each row by an error that follows that process about each axis of the body.
inline void drift_attitude(FlightLog& log, const ColouredNoise& error, std::uint64_t seed) {
  Random random(seed);
  Vec3<double> turn;
  for (double& one : turn) one = error.sigma * random.normal();
  for (std::size_t i = 0; i < log.t.size(); ++i) {
    const double left = i > 0 ? error.carried(log.t[i] - log.t[i - 1]) : 1.0;
    for (double& one : turn) one = left * one + error.sigma * std::sqrt(1 - left * left) * random.normal();
    const Vec4<double> q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    const Vec4<double> shown = quaternion_product(q, Vec4<double>(quaternion_from_rotation_vector(turn)));
    for (std::size_t k = 0; k < 4; ++k) log.q_WB[k][i] = shown[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace ident::testing
