// Low-pass filters as flight controllers run them, and delay lines.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <deque>
#include <numbers>
#include <vector>

namespace field {

// Butterworth of order 1, 2 or 4, by the bilinear transform with the cut-off prewarped: -3 dB at `hz`.
class LowPass {
 public:
  LowPass(int order, double hz, double rate);
  static LowPass none() { return {}; }
  Eigen::Vector3d operator()(const Eigen::Vector3d& x);
  bool active() const { return !sections_.empty(); }

 private:
  struct Section {
    double b0, b1, b2, a1, a2;
    Eigen::Vector3d s1 = Eigen::Vector3d::Zero(), s2 = Eigen::Vector3d::Zero();
  };
  LowPass() = default;
  std::vector<Section> sections_;
  bool started_ = false;
};

// Delay at low frequencies, s: sum of 1/(2 pi hz) times 1, sqrt(2), 2.613 for orders 1, 2 and 4.
double group_delay(int order, double hz);
// Equivalent noise bandwidth in Hz.
double noise_bandwidth(int order, double hz);

template <class T>
class Delay {
 public:
  explicit Delay(int steps) : steps_(static_cast<size_t>(steps)) {}
  T operator()(const T& x) {
    line_.push_back(x);
    if (line_.size() > steps_ + 1) line_.pop_front();
    return line_.front();
  }

 private:
  size_t steps_;
  std::deque<T> line_;
};

}  // namespace field
