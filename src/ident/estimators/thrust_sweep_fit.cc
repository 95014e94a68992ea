// Fit of one sweep, and its residuals by channel.
#include "ident/estimators/thrust_sweep_fit.h"

#include <cmath>
#include <map>

#include "ident/estimators/statistics.h"
#include "ident/estimators/thrust_sweep_model.h"

namespace ident {
namespace {

double square(double v) { return v * v; }

/// RMS over set-points, each with the mean of its residuals: what the law misses, not what the sensor
/// scatters.
double set_point_rms(const SweepChannel& channel, const ChannelResiduals& residuals) {
  std::map<int, std::vector<double>> by_set_point;
  int alone = -1;
  for (std::size_t i = 0; i < residuals.residual.size(); ++i) {
    if (residuals.rejected[i]) continue;
    const int set_point = channel.moving[i].set_point;
    by_set_point[set_point >= 0 ? set_point : --alone].push_back(residuals.residual[i]);
  }
  std::vector<double> means;
  for (const auto& [set_point, values] : by_set_point) means.push_back(mean(values));
  return root_mean_square(means);
}

ChannelResiduals residuals_of(const SweepChannel& channel, const LeastSquaresFit& fit,
                              ResidualSeries series) {
  ChannelResiduals found;
  for (Eigen::Index i = series.begin; i < series.end; ++i) {
    const SweepPoint& point = channel.moving[static_cast<std::size_t>(i - series.begin)];
    found.Omega.push_back(point.Omega);
    found.residual.push_back(-fit.residuals(i));
    found.fitted.push_back(point.value + fit.residuals(i));
    found.standardized.push_back(fit.standardized(i));
    found.rejected.push_back(fit.rejected[static_cast<std::size_t>(i)]);
  }
  const NoiseEstimate& noise = fit.noise[static_cast<std::size_t>(series.group)];
  found.noise = noise.sigma;
  found.rho = noise.rho;
  found.rms = set_point_rms(channel, found);
  return found;
}

}  // namespace

SweepFit fit_sweep(const SweepPoints& points, ThrustLaw law) {
  const SweepModel model(points, law);
  SweepFit found{.fit = solve_least_squares(model.problem())};
  found.thrust = residuals_of(points.thrust, found.fit, model.moving(0));
  if (points.has_torque()) found.torque = residuals_of(points.torque, found.fit, model.moving(1));
  found.speed_modelled = model.speed_modelled();
  if (!found.speed_modelled) return found;
  const ResidualSeries speeds = model.speeds();
  found.speed_noise = found.fit.noise[static_cast<std::size_t>(speeds.group)].sigma;
  found.speed_share = found.fit.value("speed_share");
  for (Eigen::Index i = speeds.begin; i < speeds.end; ++i)
    found.speed_outliers += found.fit.rejected[static_cast<std::size_t>(i)];
  return found;
}

double speed_noise_bias(const SweepChannel& channel, double sigma) {
  // Least squares of y over z = w^2 with a tare: cov(z, Omega^2)/var(z) - 1 = -(4 sigma^2 mean(Omega^2) +
  // 2 sigma^4)/var(z), w = Omega + noise.
  std::vector<double> z;
  for (const SweepPoint& p : channel.moving) z.push_back(square(p.Omega));
  return -(4.0 * square(sigma) * mean(z) + 2.0 * square(square(sigma))) / square(standard_deviation(z));
}

}  // namespace ident
