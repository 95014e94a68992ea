// Light turbulence with Dryden's spectra, sampled once per flight and interpolated.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "random.h"

namespace withheld {

struct GustSettings {
  double sigma = 0;  // m/s
  double time = 2;   // s, length scale over airspeed
};

class Gusts {
 public:
  Gusts(const GustSettings& settings, double duration, Random random);
  Eigen::Vector3d at(double t) const;                          // m/s, world frame
  double vortex_noise(double t) const { return noise_of(t); }  // of size 1, between 0.5 and 4 Hz

 private:
  double noise_of(double t) const;

  std::vector<Eigen::Vector3d> samples_;
  Eigen::Matrix<double, 2, 8> tones_;  // rad/s, phase
};

// Two-sided spectrum of one component, (m/s)^2/Hz.
double gust_spectrum(const GustSettings& settings, double hz);

}  // namespace withheld
