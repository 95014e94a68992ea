// Biquads and buffers.
#include "filters.h"

#include <stdexcept>

namespace field {
namespace {
constexpr double pi = std::numbers::pi;
}

LowPass::LowPass(int order, double hz, double rate) {
  const double k = std::tan(pi * hz / rate);
  const auto second = [&](double damping) {  // H = 1/(s^2 + 2 damping s + 1)
    const double n = 1 + 2 * damping * k + k * k;
    sections_.push_back(
        {k * k / n, 2 * k * k / n, k * k / n, 2 * (k * k - 1) / n, (1 - 2 * damping * k + k * k) / n});
  };
  if (order == 1) {
    sections_.push_back({k / (1 + k), k / (1 + k), 0, (k - 1) / (k + 1), 0});
  } else if (order == 2) {
    second(std::sin(pi / 4));
  } else if (order == 4) {
    second(std::sin(pi / 8));
    second(std::sin(3 * pi / 8));
  } else {
    throw std::invalid_argument("filters are of order 1, 2 or 4");
  }
}

Eigen::Vector3d LowPass::operator()(const Eigen::Vector3d& x) {
  Eigen::Vector3d y = x;
  for (Section& s : sections_) {
    if (!started_) {  // at rest at the first value
      s.s2 = (s.b2 - s.a2) * y;
      s.s1 = (s.b1 - s.a1) * y + s.s2;
    }
    const Eigen::Vector3d out = s.b0 * y + s.s1;
    s.s1 = s.b1 * y - s.a1 * out + s.s2;
    s.s2 = s.b2 * y - s.a2 * out;
    y = out;
  }
  started_ = true;
  return y;
}

double group_delay(int order, double hz) {
  const double factor = order == 1 ? 1.0 : order == 2 ? std::numbers::sqrt2 : 2.6131;
  return factor / (2 * pi * hz);
}

double noise_bandwidth(int order, double hz) {
  const double x = pi / (2 * order);
  return hz * x / std::sin(x);
}

}  // namespace field
