// Tracks read off the states and channels of an arc.
#include "ident/flight/conditioning/motion_tracks.h"

namespace ident {
namespace {

/// Rows of a vector quantity of the arc as three tracks.
template <class Value>
Track3 tracks(const FlightArc& arc, Value value) {
  Track3 out;
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    const Eigen::Vector3d v = value(i);
    for (std::size_t k = 0; k < 3; ++k) out[k].push_back(v[static_cast<Eigen::Index>(k)]);
  }
  return out;
}

}  // namespace

Track3 turn_of_attitude(const FlightArc& arc) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  return tracks(arc, [&](std::size_t i) {
    if (i == 0) return sum;
    const Vec4<double> d = quaternion_product(conjugate(arc.body[i - 1].q_WB), arc.body[i].q_WB);
    sum += (d[0] < 0 ? -2.0 : 2.0) * d.tail<3>();
    return sum;
  });
}

Track3 turn_of_rates(const FlightArc& arc) {
  return integrals(arc, tracks(arc, [&](std::size_t i) { return arc.body[i].w_B; }));
}

Track3 velocity_W(const FlightArc& arc) {
  return tracks(arc, [&](std::size_t i) { return arc.body[i].v_W; });
}

Track3 position_W(const FlightArc& arc) {
  return tracks(arc, [&](std::size_t i) { return arc.body[i].x_W; });
}

Track3 velocity_of_force(const FlightArc& arc, double gravity) {
  const Track3 f = specific_force(arc);
  return integrals(
      arc, tracks(arc, [&](std::size_t i) {
        return Eigen::Vector3d(rotation(arc.body[i].q_WB) * Eigen::Vector3d(f[0][i], f[1][i], f[2][i]) +
                               gravity * Eigen::Vector3d::UnitZ());
      }));
}

Track3 specific_force(const FlightArc& arc) {
  Track3 f;
  for (std::size_t k = 0; k < 3; ++k) {
    f[k] = channel_track(arc, kForce + static_cast<int>(k));
    if (f[k].empty()) f[k].assign(arc.rows(), 0.0);
  }
  return f;
}

Track3 integrals(const FlightArc& arc, const Track3& y) {
  return {integral(arc.t, y[0]), integral(arc.t, y[1]), integral(arc.t, y[2])};
}

}  // namespace ident
