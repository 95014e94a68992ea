// Hann window, periodic.
#include "ident/core/periodograms.h"

#include <cmath>
#include <numbers>

namespace ident {

Periodograms::Periodograms(std::size_t length)
    : window_(length), power_(length / 2 + 1, 0.0), windowed_(length) {
  for (std::size_t i = 0; i < length; ++i) {
    const double s = std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(length));
    window_[i] = s * s;
    weight_ += window_[i] * window_[i];
  }
}

void Periodograms::add(std::span<const double> stretch, double level) {
  for (std::size_t i = 0; i < window_.size(); ++i) windowed_[i] = (stretch[i] - level) * window_[i];
  fft_.fwd(transform_, windowed_);
  for (std::size_t k = 0; k < power_.size(); ++k) power_[k] += std::norm(transform_[k]);
  count_ += 1;
}

}  // namespace ident
