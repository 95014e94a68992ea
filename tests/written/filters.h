// The low-pass filters of the firmwares: a biquad Butterworth, a first-order one and Betaflight's PT2.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace written {

using Eigen::Vector3d;

// LowPassFilter2p of PX4, ArduPilot and Crazyflie.
class Butterworth {
 public:
  Butterworth(double cutoff_hz, double rate_hz) {
    const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
    const double c = 1 + std::numbers::sqrt2 * w + w * w;
    b_ = w * w / c, a1_ = 2 * (w * w - 1) / c, a2_ = (1 - std::numbers::sqrt2 * w + w * w) / c;
  }
  void reset(const Vector3d& x) { older_ = old_ = x / (1 + a1_ + a2_); }
  Vector3d operator()(const Vector3d& x) {
    const Vector3d now = x - a1_ * old_ - a2_ * older_;
    const Vector3d y = b_ * (now + 2 * old_ + older_);
    older_ = old_, old_ = now;
    return y;
  }

 private:
  double b_, a1_, a2_;
  Vector3d old_ = Vector3d::Zero(), older_ = Vector3d::Zero();
};

// `order` first-order stages in a row; the cut-off of the whole is `cutoff_hz` (pt1Filter, pt2Filter of
// Betaflight).
class Stages {
 public:
  Stages(int order, double cutoff_hz, double rate_hz) : order_(order) {
    const double correction = 1 / std::sqrt(std::pow(2.0, 1.0 / order) - 1);
    const double rc = 1 / (2 * std::numbers::pi * correction * cutoff_hz);
    k_ = 1 / (rc * rate_hz + 1);
  }
  void reset(const Vector3d& x) { state_[0] = state_[1] = x; }
  Vector3d operator()(Vector3d x) {
    for (int i = 0; i < order_; ++i) x = state_[i] += k_ * (x - state_[i]);
    return x;
  }

 private:
  int order_;
  double k_;
  Vector3d state_[2] = {Vector3d::Zero(), Vector3d::Zero()};
};

}  // namespace written
