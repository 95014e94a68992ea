// Moments and thrust of simulated rotors, moments integrated once: [flight model (3) to (5)] without rates
// and products of inertia.
#include "ident/flight/conditioning/commanded_motion.h"

#include <algorithm>

#include "ident/core/parallel.h"
#include "ident/effects/typical_scale.h"
#include "ident/flight/record/rotor_moments.h"
#include "ident/model/body.h"

namespace ident {
namespace {

void add(Track3& sum, const Eigen::Vector3d& along, const Track& of) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < of.size(); ++i) sum[k][i] += along[static_cast<Eigen::Index>(k)] * of[i];
}

// Without the line through its ends.
Eigen::MatrixXd without_drift(Eigen::MatrixXd x) {
  const auto last = x.rows() - 1;
  const Eigen::RowVectorXd from = x.row(0), slope = (x.row(last) - from) / static_cast<double>(last);
  for (Eigen::Index i = 0; i <= last; ++i) x.row(i) -= from + static_cast<double>(i) * slope;
  return x;
}

}  // namespace

Track3 commanded_motion(const FlightRecord& record, const FlightArc& arc, int group) {
  if (!arc.inputs->commanded()) return {};
  const Vehicle& vehicle = *record.vehicle;
  std::vector<double> p = record.p;
  if (!(p[param::Jp] > 0)) p[param::Jp] = typical_scale(param::Jp, vehicle, p);
  const Track still(arc.rows(), 0.0);
  Track3 out{still, still, still};
  const std::vector<RotorMoment> moments = rotor_moments(vehicle, p);
  const Eigen::Array3d J(p[param::Jxx], p[param::Jyy], p[param::Jzz]);
  const std::vector<Track> speeds = simulated_speeds(arc, vehicle, p);
  for (std::size_t n = 0; n < speeds.size(); ++n) {
    Track square = speeds[n];
    for (double& v : square) v *= v;
    if (group == kGyro) {
      add(out, moments[n].by_thrust.array() / J, integral(arc.t, square));
      add(out, moments[n].by_spin.array() / J, speeds[n]);
    } else {
      add(out, p[param::kT] / p[param::m] * axis_at(vehicle.rotors[n], p[param::alpha]), square);
    }
  }
  return out;
}

std::vector<Eigen::MatrixXd> commanded_in(const FlightRecord& record, int group, const ToneWindows& sensor) {
  std::vector<Track3> motion;
  for (const FlightArc& arc : record.arcs) motion.push_back(commanded_motion(record, arc, group));
  std::vector<Eigen::MatrixXd> out(sensor.windows.size());
  in_parallel(out.size(), [&](std::size_t k) {
    const ToneWindow& w = sensor.windows[k];
    const Track3& of_arc = motion[w.arc];
    if (of_arc[0].empty()) return;
    Eigen::MatrixXd x(w.y.rows(), 3);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        x(i, static_cast<Eigen::Index>(axis)) = of_arc[axis][w.rows[static_cast<std::size_t>(i)]];
    out[k] = without_drift(std::move(x)) * sensor.sigma.cwiseInverse().asDiagonal();
  });
  return out;
}

}  // namespace ident
