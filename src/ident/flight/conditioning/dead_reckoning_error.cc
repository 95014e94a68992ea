// Dead reckoning of one sensor by another, row by row.
#include "ident/flight/conditioning/dead_reckoning_error.h"

#include <cmath>

#include "ident/flight/record/initial_states.h"

namespace ident {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

// Three channels by row, filled between their samples; nothing without any.
class Filled {
 public:
  Filled(const FlightArc& arc, int group) {
    for (int k = 0; k < 3; ++k) columns_[static_cast<std::size_t>(k)] = filled_column(arc, group + k);
  }
  bool empty() const { return columns_[0].empty() || columns_[1].empty() || columns_[2].empty(); }
  Vector3d operator[](std::size_t i) const { return {columns_[0][i], columns_[1][i], columns_[2][i]}; }

 private:
  std::array<std::vector<double>, 3> columns_;
};

Eigen::Matrix3d cross_matrix(const Vector3d& v) {
  return Eigen::Matrix3d{{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
}

}  // namespace

void Stray::add(double t, const Vector3d& stray, const Slopes& G) {
  if (std::isfinite(begin_))
    steps += 1, square += (stray - last_).squaredNorm(), seconds += t - t_last_;
  else
    begin_ = t;
  last_ = stray, t_last_ = t;
  const auto at = static_cast<std::size_t>((t - begin_) / kStrayBin);
  while (bins.size() <= at) bins.push_back({0.0, Vector3d::Zero(), Slopes::Zero(3, nuisances)});
  bins[at].count += 1, bins[at].stray += stray, bins[at].G += G;
}

// Of the attitude from rates. Nuisances: a matrix over the angle (mounting, scale), one over the rate
// (delay), and a bias.
Stray stray_of_attitude(const FlightArc& arc) {
  Stray out(21);
  const Filled rate(arc, kGyro);
  if (rate.empty()) return out;
  const Vec4<double> still(1, 0, 0, 0);
  Vec4<double> before = still, turned = still;  // at the last sample, and since then by the rates
  Vector3d stray = Vector3d::Zero(), angle = stray;
  bool begun = false;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    if (i > 0) {
      const Vector3d step = 0.5 * (arc.t[i] - arc.t[i - 1]) * (rate[i] + rate[i - 1]);
      turned = quaternion_product(turned, quaternion_from_rotation_vector(step)), angle += step;
    }
    if (!std::isfinite(group_at(arc, i, kAttitude)[0])) continue;
    const Vec4<double> q(arc.q[4 * i], arc.q[4 * i + 1], arc.q[4 * i + 2], arc.q[4 * i + 3]);
    if (begun)
      stray += rotation_vector_from_quaternion(quaternion_product(conjugate(before), q)) -
               rotation_vector_from_quaternion(turned);
    before = q, turned = still, begun = true;
    Stray::Slopes G = Stray::Slopes::Zero(3, out.nuisances);
    for (Index axis = 0; axis < 3; ++axis)
      G.row(axis).segment<7>(7 * axis) << angle.transpose(), rate[i].transpose(), arc.t[i] - arc.t[0];
    out.add(arc.t[i], stray, G);
  }
  return out;
}

// Of the velocity from specific force. Nuisances: bias, mounting and scale of the accelerometer, its place,
// delays of attitude and velocity, and gravity or an attitude that is off by a constant.
Stray stray_of_velocity(const FlightArc& arc, double gravity) {
  Stray out(17);
  const Filled force(arc, kForce);
  if (force.empty()) return out;
  Vector3d stray = Vector3d::Zero();
  Eigen::Matrix<double, 3, 10> turned = Eigen::Matrix<double, 3, 10>::Zero();  // by the accelerometer's own
  Eigen::Matrix<double, 3, 10> slope_before = turned;
  Vector3d pull_before = stray;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    const Eigen::Matrix3d R_WB = rotation(arc.body[i].q_WB);
    const Vector3d f = force[i], pull = R_WB * f + Vector3d(0, 0, gravity);
    Eigen::Matrix<double, 3, 10> slope;
    slope << R_WB, R_WB * cross_matrix(f), R_WB * f.asDiagonal(), R_WB * cross(arc.body[i].w_B, f);
    if (i > 0) {
      const double h = 0.5 * (arc.t[i] - arc.t[i - 1]);
      stray -= h * (pull + pull_before), turned += h * (slope + slope_before);
    }
    pull_before = pull, slope_before = slope;
    if (!group_at(arc, i, kVelocity).allFinite()) continue;
    Stray::Slopes G(3, out.nuisances);
    G << turned, R_WB * cross_matrix(arc.body[i].w_B), pull,
        (arc.t[i] - arc.t[0]) * Eigen::Matrix3d::Identity();
    out.add(arc.t[i], group_at(arc, i, kVelocity) + stray, G);
  }
  return out;
}

// Of the position from velocity. Nuisances: a delay, the sensor's place, a bias.
Stray stray_of_position(const FlightArc& arc) {
  Stray out(7);
  const Filled velocity(arc, kVelocity);
  if (velocity.empty()) return out;
  Vector3d path = Vector3d::Zero();
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    if (i > 0) path += 0.5 * (arc.t[i] - arc.t[i - 1]) * (velocity[i] + velocity[i - 1]);
    if (!group_at(arc, i, kPosition).allFinite()) continue;
    Stray::Slopes G(3, out.nuisances);
    G << velocity[i], rotation(arc.body[i].q_WB), (arc.t[i] - arc.t[0]) * Eigen::Matrix3d::Identity();
    out.add(arc.t[i], group_at(arc, i, kPosition) - path, G);
  }
  return out;
}

}  // namespace ident
