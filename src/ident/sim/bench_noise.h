// What spoils a bench reading: noise with a memory, and now and then a reading that is far off.
#pragma once

#include <cmath>

#include "ident/core/random.h"

namespace ident {

/// Shares of readings, and the memory of the noise.
struct BenchDisturbance {
  double outliers = 0.0;         ///< share of readings that are 8 to 40 standard deviations off
  double autocorrelation = 0.0;  ///< of the noise from one row to the next, first order
};

/// Readings of one sensor. Noise of standard deviation 1 follows n' = rho n + sqrt(1 - rho^2) e.
class BenchSensor {
 public:
  BenchSensor(double std, const BenchDisturbance& disturbance, Random& random)
      : std_(std), disturbance_(disturbance), random_(&random), noise_(random.normal()) {}

  double operator()(double truth) {
    const double rho = disturbance_.autocorrelation;
    const double reading = truth + std_ * noise_;
    noise_ = rho * noise_ + std::sqrt(1.0 - rho * rho) * random_->normal();
    if (random_->uniform() >= disturbance_.outliers) return reading;
    return truth + std_ * (random_->below(2) ? 1 : -1) * random_->uniform(8.0, 40.0);
  }

 private:
  double std_;
  BenchDisturbance disturbance_;
  Random* random_;
  double noise_;
};

}  // namespace ident
