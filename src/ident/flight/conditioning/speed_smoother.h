// Measured rotor speeds as the input of a flight: without their noise.
#pragma once

#include <vector>

namespace ident {

/// What a rotor's speed was at each row, rad/s.
struct SmoothedSpeed {
  std::vector<double> likely;
  std::vector<double> rougher;  ///< smoothed less: what changes with it depends on the smoothing
  // Of the error of `likely`; empty where there is none.
  std::vector<double> variance;  ///< (rad/s)^2
  std::vector<double> density;   ///< of the noise of the samples, (rad/s)^2 s
};

/// The mean of what a rotor's speed was at each row, given all its samples (NaN where there is none; one that
/// repeats the last is held telemetry). Noise in an input weakens whatever acts through it, most of all what
/// acts through its rate; the error of a conditional mean does not (Berkson, J. Am. Stat. Assoc. 45, 1950).
/// The rate of the speed is a random walk; its intensity, which follows what the motor does, and the noise
/// are those that make the samples most likely. Speeds without noise, or too few to tell, come back as they
/// are, interpolated; none: empty.
SmoothedSpeed smoothed_speed(const std::vector<double>& t, const std::vector<double>& speed);

}  // namespace ident
