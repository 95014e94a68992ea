// Seeded random numbers that give the same values with every standard library.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace withheld {

class Random {
 public:
  // Streams of one seed are independent of each other: a case draws its wind from another stream than its
  // noise.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  double uniform(double low, double high);
  double log_uniform(double low, double high);
  double normal(double mean = 0, double std = 1);
  int integer(int low, int high);  // both included
  bool chance(double probability);
  Eigen::Vector3d normal3(double std);
  Eigen::Vector3d direction();  // of length 1
  double sign();                // -1 or 1

 private:
  std::uint64_t next();

  std::uint64_t state_;
  bool spare_is_set_ = false;
  double spare_ = 0;
};

}  // namespace withheld
