// A cascade tuned on a model: all gains, feed-forward and the allocation follow from the model by one rule.
#pragma once

#include "references.h"
#include "target_model.h"

namespace mended {

// What the autopilot believes, forward, left, up.
struct Belief {
  Vector3d p, v, w;
  Eigen::Quaterniond q;
};

class TunedController {
 public:
  TunedController(const TargetModel& model, const References& references);
  // Commands for the next `dt` seconds.
  Motors command(double t, const Belief& believed, double dt);
  double bandwidth() const { return b_; }

 private:
  struct Wanted {
    Eigen::Quaterniond q;
    Vector3d w, dw;  // of the reference alone
  };
  Vector3d thrust_for(const Aim& aim) const;  // m/s^2, of the reference alone, drag made up for
  Wanted wanted(double t) const;
  Vector3d correction(const Aim& aim, const Belief& believed, double dt);
  Motors limited(const Eigen::Vector4d& lift_and_moment) const;
  Eigen::Vector4d made(const Motors& motors) const;

  TargetModel m_;
  const References& references_;
  Eigen::Matrix4d allocation_, inverse_;  // motor powers to lift and moments
  double b_, d_;                          // rad/s, of the attitude loop; of the third pole
  Motors motors_{};                       // as the model has them
  Vector3d position_sum_ = Vector3d::Zero(), attitude_sum_ = Vector3d::Zero();
  double steepest_;
};

}  // namespace mended
