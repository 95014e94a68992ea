// The ground under a vehicle that is served to an autopilot: legs that spring, damp and rub.
//
//   d = z_W - ground_z                              how deep a point of the vehicle is in the ground
//   N = k d + c z_W' min(1, d/d_0), not below 0     k = m w^2/4, c = 2 zeta m w/4, d_0 = g/w^2
//   F = -min(mu N, c |v|) v/|v|                     along the ground
//
// w = 50 rad/s lets a vehicle that stands sink by 4 mm; zeta = 0.7; mu = 0.8. Assumption: four legs in a
// square below the rotors. The hubs touch the ground as well, so that a vehicle on its back lies there.
#pragma once

#include <vector>

#include "ident/sim/plant.h"

namespace ident {

class GroundContact {
 public:
  /// `legs`: height of the origin above the ground when the vehicle stands, m; 0: half the distance of the
  /// outermost hub from the origin.
  GroundContact(const Plant& plant, double legs);

  /// The origin of a vehicle that stands level, NED z, m.
  double standing_z() const;
  /// Force, N, and moment about the centre of gravity, N m, at a state; body frame.
  Wrench<double> at(const BodyState<double>& state) const;

 private:
  std::vector<Vec3<double>> points_B_;
  Vec3<double> c_B_;
  double ground_z_, legs_, stiffness_, damping_, sinks_;
};

}  // namespace ident
