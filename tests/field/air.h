// Moving air: gusts of a stated level with Dryden's time scales, their gradient over the vehicle, and bursts.
#pragma once

#include <string>
#include <vector>

#include "effects.h"

namespace field {

struct AirLevel {
  std::string name;              // as the vehicle file states it
  double across = 0, along = 0;  // m/s, standard deviation across and along the rotors' axes
};
AirLevel air_level(const std::string& name);

struct AirSample {
  Vector3d v_W = Vector3d::Zero();        // m/s, gust at the centre, without the mean wind
  Vector3d turning_B = Vector3d::Zero();  // rad/s, gradient: the gust at r is v + turning x r
};

class Gusts {
 public:
  Gusts(const AirLevel& level, double share, double span, Random random, double dt);
  AirSample next();
  double sigma_across() const { return sigma_.x(); }

 private:
  Random random_;
  Vector3d sigma_, decay_;  // of one step
  Vector3d fast_sigma_, fast_decay_;
  double turn_sigma_, turn_decay_;
  Vector3d slow_v_ = Vector3d::Zero(), fast_v_ = Vector3d::Zero(), turning_ = Vector3d::Zero();
};

std::vector<Burst> draw_bursts(Random& random, double duration, double hover_inflow);
// Downward speed of the air at time t (smooth in time).
double burst_speed(const std::vector<Burst>& bursts, double t);

}  // namespace field
