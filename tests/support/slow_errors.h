// Logs as estimators show them: slow errors, and what a filter makes of all sensors.
#pragma once

#include "ident/core/math.h"
#include "ident/core/random.h"
#include "ident/data/flight_log.h"
#include "ident/flight/kernel/noise_model.h"

namespace ident::testing {

/// An error about each of three axes that follows a Gauss-Markov process.
class SlowError {
 public:
  SlowError(const ColouredNoise& process, std::uint64_t seed) : process_(process), random_(seed) {
    for (double& one : now_) one = process_.sigma * random_.normal();
  }
  const Vec3<double>& after(double seconds) {
    const double left = process_.carried(seconds);
    for (double& one : now_)
      one = left * one + process_.sigma * std::sqrt(1 - left * left) * random_.normal();
    return now_;
  }

 private:
  ColouredNoise process_;
  Random random_;
  Vec3<double> now_;
};

/// Turns the attitude of each row about the axes of the body.
inline void drift_attitude(FlightLog& log, const ColouredNoise& process, std::uint64_t seed) {
  SlowError error(process, seed);
  for (std::size_t i = 0; i < log.t.size(); ++i) {
    const Vec3<double> turn = error.after(i > 0 ? log.t[i] - log.t[i - 1] : 0.0);
    const Vec4<double> q(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
    const Vec4<double> shown = quaternion_product(q, Vec4<double>(quaternion_from_rotation_vector(turn)));
    for (std::size_t k = 0; k < 4; ++k) log.q_WB[k][i] = shown[static_cast<Eigen::Index>(k)];
  }
}

/// Adds it to velocities or positions.
inline void drift(std::array<std::vector<double>, 3>& columns, const std::vector<double>& t,
                  const ColouredNoise& process, std::uint64_t seed) {
  SlowError error(process, seed);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Vec3<double> now = error.after(i > 0 ? t[i] - t[i - 1] : 0.0);
    for (std::size_t k = 0; k < 3; ++k) columns[k][i] += now[static_cast<Eigen::Index>(k)];
  }
}

/// Attitude, velocity and position as a complementary filter shows them that integrates rates and specific
/// force and leans on what the log held (every row), by gains of about 1/s.
inline void estimate(FlightLog& log, double gravity) {
  constexpr double kTurn = 0.7, kBias = 0.12, kVelocity = 1.0, kAlong = 0.5, kPosition = 1.0;
  const auto at = [](const std::array<std::vector<double>, 3>& columns, std::size_t i) {
    return Vec3<double>(columns[0][i], columns[1][i], columns[2][i]);
  };
  const auto attitude = [&](std::size_t i) {
    return Vec4<double>(log.q_WB[0][i], log.q_WB[1][i], log.q_WB[2][i], log.q_WB[3][i]);
  };
  Vec4<double> q = attitude(0);
  Vec3<double> v = at(log.v_W, 0), x = at(log.x_W, 0), bias = Vec3<double>::Zero();
  for (std::size_t i = 1; i < log.t.size(); ++i) {
    const double h = log.t[i] - log.t[i - 1];
    const Vec3<double> rate = 0.5 * (at(log.w_B, i) + at(log.w_B, i - 1)) - bias,
                       force = 0.5 * (at(log.f_B, i) + at(log.f_B, i - 1));
    q = quaternion_product(q, Vec4<double>(quaternion_from_rotation_vector(Vec3<double>(h * rate))));
    const Vec3<double> turn = rotation_vector_from_quaternion(quaternion_product(conjugate(q), attitude(i)));
    q = quaternion_product(q, Vec4<double>(quaternion_from_rotation_vector(Vec3<double>(kTurn * h * turn))))
            .normalized();
    bias -= kBias * h * turn;
    const Vec3<double> pushed = v + h * (rotation(q) * force + Vec3<double>(0, 0, gravity));
    x += 0.5 * h * (v + pushed), v = pushed;
    const Vec3<double> v_off = at(log.v_W, i) - v, x_off = at(log.x_W, i) - x;
    v += h * (kVelocity * v_off + kAlong * x_off), x += h * kPosition * x_off;
    for (std::size_t k = 0; k < 4; ++k) log.q_WB[k][i] = q[static_cast<Eigen::Index>(k)];
    for (std::size_t k = 0; k < 3; ++k)
      log.v_W[k][i] = v[static_cast<Eigen::Index>(k)], log.x_W[k][i] = x[static_cast<Eigen::Index>(k)];
  }
}

}  // namespace ident::testing
