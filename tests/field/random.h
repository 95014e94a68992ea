// Seeded random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <random>
#include <string_view>

namespace field {

// One stream for each case and purpose: what one part draws does not shift what another part draws.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index, std::string_view purpose) {
    std::uint64_t mixed = mix(seed) ^ mix(index + 0x51ed2701u);
    for (const char letter : purpose) mixed = mix(mixed ^ static_cast<unsigned char>(letter));
    engine_.seed(mixed);
  }

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double sign() { return chance(0.5) ? 1 : -1; }
  int integer(int low, int high) { return low + static_cast<int>(uniform(0, high - low + 1)); }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(2 * std::numbers::pi * uniform(0, 1));
  }
  // Normal, drawn anew beyond `limit` standard deviations.
  double normal_within(double limit) {
    double z = normal();
    while (std::abs(z) > limit) z = normal();
    return z;
  }
  template <class T>
  T pick(std::initializer_list<T> choices) {
    return choices.begin()[integer(0, static_cast<int>(choices.size()) - 1)];
  }

 private:
  static std::uint64_t mix(std::uint64_t x) {  // the finaliser of splitmix64
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace field
