// Seeded random numbers that are the same with every compiler and library.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace ident {

/// The engine is standardised bit by bit; the distributions of the standard library are not, so they stand
/// here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in its logarithm; both ends positive.
  double log_uniform(double low, double high) { return low * std::exp(uniform() * std::log(high / low)); }
  /// Whole number in [0, count).
  int below(int count) { return static_cast<int>(uniform() * count); }

  /// Standard normal, by Marsaglia's polar method.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u, v, s;
    do {
      u = uniform(-1.0, 1.0), v = uniform(-1.0, 1.0);
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(s) / s);
    spare_ = v * factor, has_spare_ = true;
    return u * factor;
  }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace ident
