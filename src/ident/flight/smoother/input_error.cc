// Accelerations that result from small errors of the rotor speeds, mode by mode.
#include "ident/flight/smoother/input_error.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "ident/core/statistics.h"

namespace ident {
namespace {

/// Means over rows of the error of one mode.
struct ModeError {
  double variance = 0, density = 0;
  double other = 0;  // what another smoothing would say, against this one
};

/// Rows [first, last) of the speed errors within the rows [begin, end] of an arc.
struct Span {
  std::size_t first, last;
  double rows() const { return std::max<double>(1.0, static_cast<double>(last - first)); }
};
Span span_of(const FlightArc& arc, std::size_t begin, std::size_t end) {
  const std::vector<double>& t = arc.speed_errors->t;
  return {static_cast<std::size_t>(std::ranges::lower_bound(t, arc.t[begin]) - t.begin()),
          static_cast<std::size_t>(std::ranges::upper_bound(t, arc.t[end]) - t.begin())};
}

double mean_of(const std::vector<double>& x, const Span& span) {
  double sum = 0;
  for (std::size_t i = span.first; i < span.last; ++i) sum += x[i];
  return sum / span.rows();
}

ModeError mean_error(const SpeedErrors& errors, std::size_t mode, const Span& span) {
  return {mean_of(errors.variance[mode], span), mean_of(errors.density[mode], span),
          mean_of(errors.other[mode], span)};
}

/// Accelerations per rad/s of error in a mode. Not those by the reaction to a change of speed: this acts on
/// the yaw rate together with the error itself, and is over before a constant acceleration could represent
/// it.
AccelerationVariance slope_over_mode(const FlightRecord& record, const FlightArc& arc, std::size_t mode,
                                     const Span& span, const Eigen::Matrix3d& R) {
  const std::vector<double>& p = record.p;
  const Eigen::MatrixXd& modes = arc.speed_errors->modes;
  const Eigen::Vector3d J(p[param::Jxx], p[param::Jyy], p[param::Jzz]);
  AccelerationVariance sum = AccelerationVariance::Zero();
  for (std::size_t n = 0; n < record.vehicle->rotors.size(); ++n) {
    const double share = modes.size() == 0
                             ? static_cast<double>(n == mode)
                             : modes(static_cast<Eigen::Index>(mode), static_cast<Eigen::Index>(n));
    if (share == 0) continue;
    const Rotor& rotor = record.vehicle->rotors[n];
    const Eigen::Vector3d a = axis_at(rotor, p[param::alpha]);
    const Eigen::Vector3d moment = p[param::kT] * rotor.r_B.cross(a) - rotor.s * p[param::kQ] * a;
    const double of_square = 2 * mean_of(arc.inputs->Omega[n], span) * share;
    sum.head<3>() += of_square * moment.cwiseQuotient(J);
    sum.tail<3>() += of_square * p[param::kT] / p[param::m] * (R * a);
  }
  return sum;
}

Eigen::Matrix3d axes_in(const FlightArc& arc, std::size_t row, GustAxes axes) {
  return axes == GustAxes::world ? rotation(arc.body[row].q_WB) : Eigen::Matrix3d::Identity();
}

}  // namespace

AccelerationVariance input_error(const FlightRecord& record, const FlightArc& arc, std::size_t begin,
                                 std::size_t end, GustAxes axes) {
  AccelerationVariance sum = AccelerationVariance::Zero();
  if (!arc.speed_errors) return sum;
  const double h = arc.t[end] - arc.t[begin];
  const Span span = span_of(arc, begin, end);
  for (std::size_t mode = 0; mode < arc.speed_errors->variance.size(); ++mode) {
    const ModeError e = mean_error(*arc.speed_errors, mode, span);
    const double variance = std::min(e.variance, e.density / h) + e.other * e.other;
    sum += variance * slope_over_mode(record, arc, mode, span, axes_in(arc, begin, axes)).cwiseAbs2();
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
    const Span span = span_of(arc, 0, arc.rows() - 1);
    for (std::size_t mode = 0; mode < arc.speed_errors->variance.size(); ++mode) {
      // In the middle of all rows: a hole in the samples says nothing of the others.
      const double usual = median(arc.speed_errors->variance[mode]);
      variance += share * usual, density += share * median(arc.speed_errors->density[mode]);
      sum += usual * slope_over_mode(record, arc, mode, span, axes_in(arc, 0, axes)).cwiseAbs2();
    }
    out.variance += share * sum, rows += share;
  }
  if (rows > 0) out.variance /= rows;
  if (variance > 0) out.time = density / (2 * variance);
  return out;
}

}  // namespace ident
