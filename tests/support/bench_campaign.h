// Random vehicles and generated bench data with known truth, and the tally of how well estimates do on them.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "ident/data/table.h"
#include "ident/result/result.h"

namespace ident::bench {

/// Seeded source of everything random in a campaign.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double log_uniform(double low, double high);
  double normal() { return std::normal_distribution<double>()(engine_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 engine_;
};

/// Stationary noise of standard deviation 1, autocorrelation rho at lag one.
class ColouredNoise {
 public:
  ColouredNoise(Random& random, double rho) : random_(random), rho_(rho) {}
  double next();

 private:
  Random& random_;
  double rho_, last_ = 0.0;
  bool started_ = false;
};

/// A vehicle drawn log-uniform: mass 0.03 to 5 kg, arm 0.03 to 0.5 m, motors 5 to 80 rad/s, damping 0.4 to 2.
struct BenchVehicle {
  double mass, arm, thrust_to_weight;
  double km, omega_m, zeta_m, dead_time;
  double Jxx, Jyy, Jzz;
};
BenchVehicle random_vehicle(Random& random);

/// What is wrong with the data besides white noise.
struct Disturbance {
  double outliers = 0.0;  ///< share of samples
  double rho = 0.0;       ///< autocorrelation of the noise
};

struct GeneratedTable {
  NumberTable table;
  double noise = 0.0;  ///< standard deviation of the clean noise
  /// Smallest standard deviation that an unbiased estimate from the clean rows can have.
  std::map<std::string, double> cramer_rao;
};

/// `rows` swings of each axis and of the platform, with a stopwatch of equal error for all.
GeneratedTable pendulum(const BenchVehicle& vehicle, Random& random, int rows,
                        const Disturbance& disturbance);

/// A recording of command steps. `noise` in rad/s; the static curve is
/// Omega_0 + km delta (1 + curvature (delta - 1/2)).
struct StepTest {
  double rate = 100.0;  ///< Hz, on average; the times are not uniform
  double noise = 2.0;
  double Omega_0 = 0.0, curvature = 0.0;
  double down_ratio = 1.0;  ///< omega_m after an edge down over that after an edge up
  Disturbance disturbance = {};
};

/// Steps up and down between 20 % and 80 % of the command, each long enough to settle.
GeneratedTable motor_steps(const BenchVehicle& vehicle, Random& random, const StepTest& test);
/// A sweep with tare offsets: rows at rest, then five rows at each set-point, with a noisy speed sensor and
/// the offset of a tenth of full speed in the command curve.
GeneratedTable thrust_sweep(const BenchVehicle& vehicle, double kT, double kQ, Random& random,
                            const Disturbance& disturbance);

/// Errors of one parameter over many runs.
struct Tally {
  int runs = 0, covered = 0;
  double error = 0.0, square = 0.0;  ///< of (estimate - truth)/std
  double bound_square = 0.0;         ///< of (estimate - truth)/(Cramer-Rao bound)

  void add(const Parameter& estimate, double truth, double cramer_rao);
  double bias() const { return error / runs; }
  double spread() const;
  double coverage() const { return static_cast<double>(covered) / runs; }
  /// RMS error over the RMS bound.
  double efficiency() const;
};

using Tallies = std::map<std::string, Tally>;

/// Fits `runs` generated data sets of random vehicles.
Tallies inertia_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance);
Tallies motor_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance);
Tallies thrust_campaign(int runs, std::uint64_t seed, const Disturbance& disturbance);

/// One line per parameter.
std::string as_markdown(const std::string& title, const Tallies& tallies);

}  // namespace ident::bench
