// Light turbulence: the longitudinal form 1/(1 + T s), the lateral forms (1 + sqrt(3) T s)/(1 + T s)^2.
#include "gusts.h"

#include <algorithm>
#include <cmath>

namespace withheld {

namespace {
constexpr double kGrid = 0.005;  // s
}

Gusts::Gusts(const GustSettings& settings, double duration, Random random) {
  const auto n = static_cast<std::size_t>(duration / kGrid) + 3;
  samples_.reserve(n);
  const double T = settings.time, decay = std::exp(-kGrid / T);
  const double drive = std::sqrt(2 * T / kGrid) * (1 - decay);  // unit variance of 1/(1 + T s)
  Eigen::Vector3d first = random.normal3(1), second = first;
  for (std::size_t i = 0; i < n; ++i) {
    first = decay * first + drive * random.normal3(1);
    second = decay * second + (1 - decay) * first;
    // (1 + c T s)/(1 + T s)^2 = (c + (1 - c)/(1 + T s))/(1 + T s)
    const double c = std::sqrt(3.0), scale = std::sqrt(0.5);
    const Eigen::Vector3d lateral = scale * (c * first + (1 - c) * second);
    samples_.push_back(settings.sigma * Eigen::Vector3d(first.x(), lateral.y(), lateral.z()));
  }
  for (int k = 0; k < tones_.cols(); ++k) {
    tones_(0, k) = 2 * M_PI * random.uniform(0.5, 4);
    tones_(1, k) = random.uniform(0, 2 * M_PI);
  }
}

Eigen::Vector3d Gusts::at(double t) const {
  const double x = std::clamp(t / kGrid, 0.0, static_cast<double>(samples_.size() - 2));
  const auto i = static_cast<std::size_t>(x);
  const double part = x - static_cast<double>(i);
  return (1 - part) * samples_[i] + part * samples_[i + 1];
}

double Gusts::noise_of(double t) const {
  double sum = 0;
  for (int k = 0; k < tones_.cols(); ++k) sum += std::sin(tones_(0, k) * t + tones_(1, k));
  return sum / 2;
}

double gust_spectrum(const GustSettings& settings, double hz) {
  const double x = 2 * M_PI * hz * settings.time;
  return settings.sigma * settings.sigma * 2 * settings.time / (1 + x * x);
}

}  // namespace withheld
