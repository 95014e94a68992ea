// Half a second ahead by a target's equations, from true states and real commands, against what was flown.
//
// The mean wind belongs to the day and not to the vehicle: every model flies in it. Gusts are left out.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "../withheld/simulate.h"
#include "target_model.h"

namespace mended {

// A flight as a target would have it: forward, left, up; at the rows of the log.
struct TrueFlight {
  // `wind` is the mean wind, north, east, down.
  TrueFlight(const withheld::Flight& flight, const Vector3d& wind);
  Vector3d wind;  // m/s, north, west, up
  std::vector<double> t;
  std::vector<Motors> delta;  // real commands, each holds to the next row
  std::vector<Vector3d> v, w;
  std::vector<Eigen::Quaterniond> q;
  std::size_t rows_in(double seconds) const;
};

// Velocity m/s, attitude rad, body rates rad/s.
struct Errors {
  double v = 0, attitude = 0, rate = 0;
};

struct Horizon {
  double length = 0.5, every = 0.5;  // s, of a window; between their starts
  int samples = 5;                   // compared in each window, equally spaced
};

// RMS change of the true states over the same windows: the error of a forecast that nothing changes.
Errors changes(const std::vector<TrueFlight>& flights, const Horizon& horizon);

// Differences over `unit`, nine numbers a sample: velocity, attitude, rates.
Eigen::VectorXd residuals(const TargetModel& model, const std::vector<TrueFlight>& flights,
                          const Horizon& horizon, const Errors& unit);
// The same by the equations of the tests. `c` is the centre of gravity from the vehicle's origin, forward,
// left, up.
Eigen::VectorXd residuals(const ident::test::SimulatorEquations& equations, const Vector3d& c,
                          const std::vector<TrueFlight>& flights, const Horizon& horizon, const Errors& unit);

// RMS of each kind, in its unit.
Errors rms(const Eigen::VectorXd& residuals, const Errors& unit);
// Root of the mean square of the three errors, each over its unit: the figure that is compared.
double pooled(const Errors& errors, const Errors& unit);

}  // namespace mended
