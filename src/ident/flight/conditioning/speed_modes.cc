// Householder's QR of what each rotor does; samples that not all rotors have are none.
#include "ident/flight/conditioning/speed_modes.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "ident/core/parallel.h"
#include "ident/flight/conditioning/speed_smoother.h"

namespace ident {
namespace {

// Share of the rows with a new sample in which some rotors lack one: more, and they are not sampled together.
constexpr double kApart = 0.1;

using Columns = std::vector<std::vector<double>>;

bool sampled_together(const Columns& speeds) {
  std::vector<double> last(speeds.size(), kNaN);
  double rows = 0, apart = 0;
  for (std::size_t i = 0; i < speeds[0].size(); ++i) {
    std::size_t fresh = 0;
    for (std::size_t n = 0; n < speeds.size(); ++n) {
      if (!std::isfinite(speeds[n][i])) continue;
      fresh += speeds[n][i] != last[n];
      last[n] = speeds[n][i];
    }
    rows += fresh > 0, apart += fresh > 0 && fresh < speeds.size();
  }
  return apart <= kApart * rows;
}

// Each row times a matrix.
Columns turned(const Columns& x, const Eigen::MatrixXd& by) {
  Columns out(x.size(), std::vector<double>(x[0].size(), 0.0));
  for (std::size_t j = 0; j < x.size(); ++j)
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double share = by(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(n));
      for (std::size_t i = 0; i < x[n].size(); ++i) out[j][i] += share * x[n][i];
    }
  return out;
}

}  // namespace

Eigen::MatrixXd speed_modes(const Vehicle& vehicle, std::span<const double> p) {
  const auto rotors = static_cast<Eigen::Index>(vehicle.rotors.size());
  Eigen::MatrixXd does(rotors, 4);
  for (Eigen::Index n = 0; n < rotors; ++n) {
    const Rotor& rotor = vehicle.rotors[static_cast<std::size_t>(n)];
    const Eigen::Vector3d a = axis_at(rotor, p[param::alpha]);
    does.row(n) << a[2], (p[param::kT] * rotor.r_B.cross(a) - rotor.s * p[param::kQ] * a).transpose();
  }
  for (Eigen::Index k = 0; k < 4; ++k) does.col(k) /= std::max(does.col(k).norm(), 1e-300);
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(does).householderQ();
  return Q.transpose();
}

SmoothedSpeeds smoothed_speeds(const std::vector<double>& t, const Columns& speeds,
                               const Eigen::MatrixXd& modes) {
  const std::size_t count = speeds.size();
  const bool any_empty = std::ranges::any_of(speeds, [](const auto& s) { return s.empty(); });
  const bool together = count > 1 && !any_empty && sampled_together(speeds);
  const Columns seen = together ? turned(speeds, modes) : speeds;
  SmoothedSpeeds out{Columns(count), Columns(count), {t, Columns(count), Columns(count), Columns(count), {}}};
  SpeedErrors& errors = out.errors;
  if (together) errors.modes = modes;
  in_parallel(count, [&](std::size_t j) {
    SmoothedSpeed one = smoothed_speed(t, seen[j]);
    out.likely[j] = std::move(one.likely), out.rougher[j] = std::move(one.rougher);
    errors.variance[j] = std::move(one.variance), errors.density[j] = std::move(one.density);
    for (std::size_t i = 0; i < out.likely[j].size(); ++i)
      errors.other[j].push_back(out.rougher[j][i] - out.likely[j][i]);
  });
  const auto has_noise = [](const std::vector<double>& variance) { return !variance.empty(); };
  if (std::ranges::none_of(errors.variance, has_noise)) errors.t.clear();
  for (auto* of : {&errors.variance, &errors.density, &errors.other})
    for (auto& column : *of) column.resize(t.size(), 0.0);
  if (!together) return out;
  out.likely = turned(out.likely, modes.transpose()), out.rougher = turned(out.rougher, modes.transpose());
  return out;
}

}  // namespace ident
