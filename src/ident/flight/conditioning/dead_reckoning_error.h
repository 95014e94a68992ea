// What one sensor of a log strays from the integral of another by, without a model of the vehicle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/flight/record/flight_record.h"

namespace ident {

inline constexpr double kStrayBin = 0.05;  ///< s

/// The stray at its samples, and what goes with the nuisances: columns of G, of which one unknown each is
/// common to all axes. Sums over bins of time, of which some may be empty.
struct Stray {
  using Slopes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 21>;
  struct Bin {
    double count = 0;
    Eigen::Vector3d stray = Eigen::Vector3d::Zero();
    Slopes G;
  };
  Eigen::Index nuisances;
  std::vector<Bin> bins;
  double steps = 0, square = 0, seconds = 0;  ///< from sample to sample; squares of all axes

  explicit Stray(Eigen::Index of) : nuisances(of) {}
  void add(double t, const Eigen::Vector3d& stray, const Slopes& G);

 private:
  double begin_ = kNaN, t_last_ = kNaN;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
};

/// Of the attitude from integrated rates, about the axes of the body, rad.
Stray stray_of_attitude(const FlightArc& arc);
/// Of the velocity from integrated specific force, in the world, m/s.
Stray stray_of_velocity(const FlightArc& arc, double gravity);
/// Of the position from integrated velocity, in the world, m.
Stray stray_of_position(const FlightArc& arc);

/// What the three channels of a group show in a row; NaN where not sampled.
inline Eigen::Vector3d group_at(const FlightArc& arc, std::size_t row, int group) {
  const double* y = arc.y.data() + row * kChannels + group;
  return {y[0], y[1], y[2]};
}

}  // namespace ident
