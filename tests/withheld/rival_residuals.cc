// Equation errors: accelerometer, differenced gyro, changes of velocity and attitude over 0.1 s, rotor
// speeds.
#include <cmath>

#include "rival_model.h"

namespace rival {

namespace {

void force_and_moment_rows(const Log& log, const Accelerations& a, const Terms& x, Series* y) {
  const std::size_t n = log.blocks.size();
  for (std::size_t s = 0; s < 6; ++s) (*y)[s] = VectorXd::Zero(static_cast<Eigen::Index>(n));
  const double h = log.step();
  const auto late = [&](std::size_t k) {  // the angular acceleration that a delayed, turned gyro shows
    const double at = std::max(0.0, static_cast<double>(k) - x.tau / h);
    const auto low = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(low);
    const Vector3d value = (1 - part) * a.dw[low] + part * a.dw[std::min(low + 1, n - 1)];
    return Vector3d(value - x.turn.cross(value));
  };
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Vector3d force = log.blocks[k].acc - a.shown[k];
    const double span = log.blocks[k + 1].t - log.blocks[k - 1].t;
    const Vector3d slope = (log.blocks[k + 1].gyro - log.blocks[k - 1].gyro) / span;
    const Vector3d moment = slope - 0.25 * late(k - 1) - 0.5 * late(k) - 0.25 * late(k + 1);
    for (int i = 0; i < 3; ++i) {
      (*y)[static_cast<std::size_t>(i)][static_cast<Eigen::Index>(k)] = force[i];
      (*y)[static_cast<std::size_t>(3 + i)][static_cast<Eigen::Index>(k)] = moment[i];
    }
  }
}

void change_rows(const Log& log, const Accelerations& a, const Terms& x, double gravity, Series* y) {
  const std::size_t spans = log.fixes.size() - 1;
  for (std::size_t s = 6; s < 12; ++s) (*y)[s] = VectorXd::Zero(static_cast<Eigen::Index>(spans));
  for (std::size_t i = 0; i < spans; ++i) {
    const std::size_t from = log.fixes[i], to = log.fixes[i + 1];
    Vector3d dv = Vector3d::Zero();
    Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
    for (std::size_t k = from; k < to; ++k) {
      const double dt = log.blocks[k + 1].t - log.blocks[k].t;
      for (const std::size_t end : {k, k + 1}) {
        const Vector3d w = log.blocks[end].gyro - x.gyro_bias;
        const Vector3d f = a.f[end] + x.tau * w.cross(a.f[end]);  // the attitude shown is old
        dv += 0.5 * dt * (log.blocks[end].q * f + Vector3d(0, 0, gravity));
      }
      const Vector3d w = 0.5 * (log.blocks[k].gyro + log.blocks[k + 1].gyro) - x.gyro_bias;
      const Vector3d half = 0.5 * dt * (w + x.turn.cross(w));
      turned = (turned * Eigen::Quaterniond(1, half.x(), half.y(), half.z())).normalized();
    }
    const double span = log.blocks[to].t - log.blocks[from].t;
    const Eigen::Quaterniond off = turned.conjugate() * (log.blocks[from].q.conjugate() * log.blocks[to].q);
    const Vector3d angle = 2 * (off.w() < 0 ? -1 : 1) * off.vec() / span;
    const Vector3d change = (log.blocks[to].v - log.blocks[from].v - dv) / span;
    const Vector3d force = log.blocks[(from + to) / 2].q.conjugate() * change;
    for (int k = 0; k < 3; ++k) {
      (*y)[static_cast<std::size_t>(6 + k)][static_cast<Eigen::Index>(i)] = force[k];
      (*y)[static_cast<std::size_t>(9 + k)][static_cast<Eigen::Index>(i)] = angle[k];
    }
  }
}

}  // namespace

Series Model::residuals(std::size_t l, const VectorXd& theta) const {
  const Log& log = logs_[l];
  const Terms x = terms(l, theta);
  const Spin& predicted = spin(l, x);
  const Accelerations a = accelerate(log, predicted, x);
  Series y;
  force_and_moment_rows(log, a, x, &y);
  change_rows(log, a, x, vehicle_.gravity, &y);
  for (int i = 0; i < 4; ++i) {
    VectorXd& speed = y[static_cast<std::size_t>(12 + i)];
    speed = VectorXd::Zero(log.has_speed ? static_cast<Eigen::Index>(log.blocks.size()) : 0);
    for (Eigen::Index k = 0; k < speed.size(); ++k) {
      const auto block = static_cast<std::size_t>(k);
      speed[k] = log.blocks[block].speed[i] - predicted.Omega[block][i];
    }
  }
  return y;
}

std::vector<Series> Model::residuals(const VectorXd& theta) const {
  std::vector<Series> result;
  for (std::size_t l = 0; l < logs_.size(); ++l) result.push_back(residuals(l, theta));
  return result;
}

}  // namespace rival
