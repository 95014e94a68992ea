// Fit of one sweep, and its residuals by channel.
#include "ident/bench/thrust/thrust_sweep_fit.h"

#include <cmath>
#include <map>
#include <memory>

#include "ident/bench/thrust/thrust_sweep_model.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_fit.h"

namespace ident {
namespace {

constexpr std::size_t kFewestForRestNoise = 5;
constexpr double kRestDiffers = 1e-3;  // probability below which the noise at rest counts as another one

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
                              const SweepModel& model, std::size_t number) {
  ChannelResiduals found;
  const std::vector<Eigen::Index>& places = model.moving(number);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Index i = places[k];
    found.Omega.push_back(channel.moving[k].Omega);
    found.residual.push_back(-fit.residuals(i));
    found.fitted.push_back(channel.moving[k].value + fit.residuals(i));
    found.standardized.push_back(fit.standardized(i));
    found.rejected.push_back(fit.rejected[static_cast<std::size_t>(i)]);
  }
  const NoiseEstimate& noise = fit.noise[model.group(number)];
  found.noise = noise.sigma;
  found.rho = noise.rho;
  found.rms = set_point_rms(channel, found);
  return found;
}

/// Do readings at rest scatter more or less than those in motion (F test on decorrelated residuals)?
bool rest_differs(const LeastSquaresFit& fit, const SweepModel& model, std::size_t channel) {
  const auto list = [&](const std::vector<Eigen::Index>& places) {
    std::vector<double> kept;
    for (const Eigen::Index i : places)
      if (std::isfinite(fit.standardized(i))) kept.push_back(fit.standardized(i));
    return kept;
  };
  const std::vector<double> rest = list(model.at_rest(channel)), moving = list(model.moving(channel));
  if (rest.size() < kFewestForRestNoise || moving.size() < kFewestForRestNoise) return false;
  const double p = f_cdf(square(root_mean_square(rest) / root_mean_square(moving)),
                         static_cast<double>(rest.size()), static_cast<double>(moving.size()));
  return std::fmin(p, 1.0 - p) < 0.5 * kRestDiffers;
}

}  // namespace

SweepFit fit_sweep(const SweepPoints& points, ThrustLaw law) {
  auto model = std::make_unique<SweepModel>(points, law, RestNoise::alike);
  SweepFit found{.fit = solve_least_squares(model->problem())};
  if (!points.averaged &&
      (rest_differs(found.fit, *model, 0) || (points.has_torque() && rest_differs(found.fit, *model, 1)))) {
    model = std::make_unique<SweepModel>(points, law, RestNoise::own);
    found.fit = solve_least_squares(model->problem());
  }
  found.thrust = residuals_of(points.thrust, found.fit, *model, 0);
  if (points.has_torque()) found.torque = residuals_of(points.torque, found.fit, *model, 1);
  found.speed_modelled = model->speed_modelled();
  if (!found.speed_modelled) return found;
  const ResidualSeries speeds = model->speeds();
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
