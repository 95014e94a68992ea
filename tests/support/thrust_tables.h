// Small thrust sweeps and logs with known truth: kT = 6e-6, kQ = 9e-8, Omega = 150 + 1000 delta.
#pragma once

#include <string>
#include <vector>

#include "ident/data/table.h"

namespace ident::bench {

/// A table of rows at set-points; everything that may be wrong with it is a field.
struct SweepTable {
  unsigned seed = 1;
  int set_points = 12, repeats = 5, at_rest = 5;
  double noise = 0.005;       ///< of full scale, thrust and torque
  double rho = 0.0;           ///< autocorrelation of that noise
  double speed_noise = 1.0;   ///< rad/s, of the sensor
  double speed_wander = 0.0;  ///< rad/s, of the rotor
  double linear_term = 0.0;   ///< N s/rad

  NumberTable table() const;
  /// The table kept, so that it can be spoilt.
  NumberTable& made();

 private:
  NumberTable made_;
};

/// A log at 50 Hz: rest, ten steps of 4 s up, rest; forces behind a load cell with a lag of 0.25 s.
struct Staircase {
  double drift = 0.0;  ///< N, of the thrust's tare over the log
};
NumberTable staircase_table(const Staircase& options);

/// A ramp from 200 to 1150 rad/s and back in 20 s at 50 Hz, forces through a lag.
NumberTable ramp_table(double lag);

/// The values of a column; it has to be there.
std::vector<double>& values(NumberTable& table, const std::string& name);
void drop_column(NumberTable& table, const std::string& name);

}  // namespace ident::bench
