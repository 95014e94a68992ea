// Thrust and reaction torque of rotors whose speeds are a little off.
#include "ident/estimators/flight_input_error.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "ident/estimators/statistics.h"

namespace ident {
namespace {

/// Means over rows of what is known of a rotor.
struct RotorError {
  double speed = 0, variance = 0, density = 0;
  double other = 0;  // what another smoothing would say, against this one
};

RotorError mean_error(const FlightArc& arc, std::size_t rotor, std::size_t begin, std::size_t end) {
  const SpeedErrors& errors = *arc.speed_errors;
  const auto first = std::ranges::lower_bound(errors.t, arc.t[begin]) - errors.t.begin();
  const auto last = std::ranges::upper_bound(errors.t, arc.t[end]) - errors.t.begin();
  RotorError sum;
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
    sum.speed += arc.inputs->Omega[rotor][i], sum.other += errors.other[rotor][i];
    sum.variance += errors.variance[rotor][i], sum.density += errors.density[rotor][i];
  }
  const double rows = std::max<double>(1.0, static_cast<double>(last - first));
  return {sum.speed / rows, sum.variance / rows, sum.density / rows, sum.other / rows};
}

/// Adds what an error of that variance does in a rotor's speed. Not by the spin-up: what that does to the yaw
/// rate goes with the error itself and is over before an acceleration that is even for a while could hold it.
void add_rotor(const FlightRecord& record, const Rotor& rotor, const Eigen::Matrix3d& R, double speed,
               double variance, AccelerationVariance& sum) {
  const std::vector<double>& p = record.p;
  const Eigen::Vector3d a = axis_at(rotor, p[param::alpha]);
  const Eigen::Vector3d J(p[param::Jxx], p[param::Jyy], p[param::Jzz]);
  const Eigen::Vector3d moment = p[param::kT] * rotor.r_B.cross(a) - rotor.s * p[param::kQ] * a;
  const Eigen::Vector3d push = p[param::kT] / p[param::m] * (R * a);
  const double of_square = 4 * speed * speed * variance;
  sum.head<3>() += of_square * moment.cwiseQuotient(J).cwiseAbs2();
  sum.tail<3>() += of_square * push.cwiseAbs2();
}

Eigen::Matrix3d axes_in(const FlightArc& arc, std::size_t row, GustAxes axes) {
  return axes == GustAxes::world ? rotation(arc.start[row].body.q_WB) : Eigen::Matrix3d::Identity();
}

}  // namespace

AccelerationVariance input_error(const FlightRecord& record, const FlightArc& arc, std::size_t begin,
                                 std::size_t end, GustAxes axes) {
  AccelerationVariance sum = AccelerationVariance::Zero();
  if (!arc.speed_errors) return sum;
  const double h = arc.t[end] - arc.t[begin];
  for (std::size_t n = 0; n < record.vehicle->rotors.size(); ++n) {
    const RotorError e = mean_error(arc, n, begin, end);
    add_rotor(record, record.vehicle->rotors[n], axes_in(arc, begin, axes), e.speed,
              std::min(e.variance, e.density / h) + e.other * e.other, sum);
  }
  return sum;
}

InputErrorProcess input_error_process(const FlightRecord& record, GustAxes axes) {
  InputErrorProcess out;
  double variance = 0, density = 0, rows = 0;
  for (const FlightArc& arc : record.arcs) {
    if (!arc.speed_errors) continue;
    const double share = static_cast<double>(arc.rows());
    AccelerationVariance sum = AccelerationVariance::Zero();
    for (std::size_t n = 0; n < record.vehicle->rotors.size(); ++n) {
      const double speed = mean_error(arc, n, 0, arc.rows() - 1).speed;
      // In the middle of all rows: a hole in the samples says nothing of the others.
      const double usual = median(arc.speed_errors->variance[n]);
      variance += share * usual, density += share * median(arc.speed_errors->density[n]);
      add_rotor(record, record.vehicle->rotors[n], axes_in(arc, 0, axes), speed, usual, sum);
    }
    out.variance += share * sum, rows += share;
  }
  if (rows > 0) out.variance /= rows;
  if (variance > 0) out.time = density / (2 * variance);
  return out;
}

}  // namespace ident
