// Seeded random numbers: splitmix64 and the polar form of Box and Muller.
#include "random.h"

#include <cmath>

namespace withheld {

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(seed * 0x9E3779B97F4A7C15ULL ^ (stream + 1) * 0xD1B54A32D192ED03ULL) {
  for (int i = 0; i < 4; ++i) next();
}

std::uint64_t Random::next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(next() >> 11) * 0x1.0p-53;
}

double Random::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

double Random::normal(double mean, double std) {
  if (spare_is_set_) {
    spare_is_set_ = false;
    return mean + std * spare_;
  }
  double u = 0, v = 0, s = 0;
  do {
    u = uniform(-1, 1);
    v = uniform(-1, 1);
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  const double scale = std::sqrt(-2 * std::log(s) / s);
  spare_ = v * scale;
  spare_is_set_ = true;
  return mean + std * u * scale;
}

int Random::integer(int low, int high) {
  const auto span = static_cast<std::uint64_t>(high - low + 1);
  return low + static_cast<int>(next() % span);
}

bool Random::chance(double probability) { return uniform(0, 1) < probability; }

Eigen::Vector3d Random::normal3(double std) {
  const double x = normal(0, std), y = normal(0, std), z = normal(0, std);
  return {x, y, z};
}

Eigen::Vector3d Random::direction() {
  Eigen::Vector3d v = normal3(1);
  while (v.norm() < 1e-3) v = normal3(1);
  return v.normalized();
}

double Random::sign() { return chance(0.5) ? 1 : -1; }

}  // namespace withheld
