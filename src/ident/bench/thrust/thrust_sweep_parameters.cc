// Constants over all files, and what follows from them.
#include "ident/bench/thrust/thrust_sweep_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/thrust/thrust_sweep_pool.h"
#include "ident/bench/thrust/thrust_sweep_rotor.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

using Files = std::vector<SweepFile>;

double dof_of(const LeastSquaresFit& fit, const std::string& name) {
  return fit.dof_of(Eigen::VectorXd::Unit(fit.x.size(), fit.index(name)));
}

/// A constant over all files that have it. One file keeps its own interval and naive deviation.
template <class FitOf>
std::optional<Parameter> over_files(const Files& files, const std::string& name, const std::string& unit,
                                    const FitOf& fit_of, std::vector<Warning>& warnings) {
  std::vector<const LeastSquaresFit*> fits;
  for (const SweepFile& file : files)
    if (const LeastSquaresFit* fit = fit_of(file)) fits.push_back(fit);
  if (fits.empty()) return std::nullopt;
  if (fits.size() == 1) return fitted_parameter(*fits[0], name, unit, "thrust");
  std::vector<FileEstimate> estimates;
  for (const LeastSquaresFit* fit : fits)
    estimates.push_back({fit->value(name), fit->std(name), dof_of(*fit, name)});
  const PooledEstimate pooled = pool(estimates);
  if (pooled.files_differ)
    warnings.push_back(
        {"files_differ",
         fmt::format("{} differs between the files by {:.1f} % beyond their own errors (p = "
                     "{:.1g}): its interval is that of a mean over such files. See the table for "
                     "each one",
                     name, 100.0 * pooled.scatter, pooled.p_equal)});
  return pooled_parameter(name, pooled, unit, "thrust");
}

const LeastSquaresFit* thrust_fit(const SweepFile& file) { return &file.fit.fit; }
const LeastSquaresFit* torque_fit(const SweepFile& file) {
  return file.has_torque() ? &file.fit.fit : nullptr;
}
const LeastSquaresFit* curve_fit(const SweepFile& file) { return file.curve ? &file.curve->fit : nullptr; }

Parameter scaled(Parameter p, std::string name, double factor, std::string unit) {
  p.name = std::move(name);
  p.unit = std::move(unit);
  p.value *= factor, p.std *= factor, p.ci95[0] *= factor, p.ci95[1] *= factor;
  if (p.naive_std) *p.naive_std *= factor;
  return p;
}

/// kT^1.5/(kQ sqrt(2 rho A)): relative errors add with weights 1.5 and -1.
Parameter merit_parameter(const Parameter& kT, const Parameter& kQ, double rho_kTkQ, double radius,
                          double rho) {
  const double merit = figure_of_merit(kT.value, kQ.value, radius, rho);
  const double u = 1.5 * kT.std / kT.value, v = kQ.std / kQ.value;
  const double relative = std::sqrt(std::max(0.0, u * u + v * v - 2.0 * rho_kTkQ * u * v));
  const double half = normal_quantile(0.975) * relative;
  return {.name = "figure_of_merit",
          .value = merit,
          .std = merit * relative,
          .ci95 = {merit * std::exp(-half), merit * std::exp(half)},
          .unit = "-",
          .identifiable = relative < 0.1,
          .source = "thrust"};
}

void add_rotor(Result& result, const ThrustOptions& options, double rho_kTkQ) {
  if (!options.radius) return;
  const double R = *options.radius, rho = options.rho;
  const Parameter kT = *result.find("kT");
  result.parameters.push_back(scaled(kT, "CT", thrust_coefficient(1.0, R, rho), "-"));
  if (!result.find("kQ")) return;
  const Parameter kQ = *result.find("kQ");
  result.parameters.push_back(scaled(kQ, "CQ", torque_coefficient(1.0, R, rho), "-"));
  result.parameters.push_back(merit_parameter(kT, kQ, rho_kTkQ, R, rho));
}

void add_curve(Result& result, const Files& files) {
  auto km = over_files(files, "km", "rad/s", curve_fit, result.warnings);
  if (!km) return;
  std::vector<double> offsets, stds;
  for (const SweepFile& file : files)
    if (file.curve)
      offsets.push_back(file.curve->fit.value("Omega_0")), stds.push_back(file.curve->fit.std("Omega_0"));
  for (const SweepFile& file : files) {
    if (!file.curve || offsets.size() > 1) continue;
    Parameter offset = fitted_parameter(file.curve->fit, "Omega_0", "rad/s", "thrust");
    // Its size is to be judged against full speed: an offset near zero is known well, not badly.
    offset.identifiable = offset.std < 0.1 * km->value;
    result.parameters.push_back(offset);
    result.correlation = result.correlation.beside(fitted_correlation(file.curve->fit, {"km", "Omega_0"}));
  }
  if (offsets.size() > 1) {
    const RobustMean over = robust_mean(offsets);
    const double std =
        std::hypot(over.std, root_mean_square(stds) / std::sqrt(static_cast<double>(stds.size())));
    const double half = t95(over.dof) * std;
    result.parameters.push_back({.name = "Omega_0",
                                 .value = over.value,
                                 .std = std,
                                 .ci95 = {over.value - half, over.value + half},
                                 .unit = "rad/s",
                                 .identifiable = std < 0.1 * km->value,
                                 .source = "thrust"});
  }
  result.parameters.push_back(*km);
}

/// Motor constants of the first file that tells them, else of the first that says why not.
void add_motor(Result& result, const Files& files) {
  const SweepFile* best = nullptr;
  for (const SweepFile& file : files)
    if (file.motor && (!best || (file.motor->missing.empty() && !best->motor->missing.empty()))) best = &file;
  if (!best) return;
  result.parameters.insert(result.parameters.end(), best->motor->parameters.begin(),
                           best->motor->parameters.end());
  if (best->motor->side)
    result.extra["current_measured_at"] = *best->motor->side == CurrentSide::motor ? "motor" : "battery";
}

}  // namespace

double thrust_torque_covariance(const std::vector<SweepFile>& files) {
  double covariance = 0.0, thrust = 0.0, torque = 0.0;
  for (const SweepFile& file : files) {
    const LeastSquaresFit& fit = file.fit.fit;
    const Eigen::Index T = fit.index("kT");
    const double u = 1.0 / fit.covariance(T, T);
    thrust += u;
    if (!file.has_torque()) continue;
    const Eigen::Index Q = fit.index("kQ");
    const double v = 1.0 / fit.covariance(Q, Q);
    covariance += u * v * fit.covariance(T, Q), torque += v;
  }
  return covariance / (thrust * torque);
}

void add_sweep_parameters(Result& result, const std::vector<SweepFile>& files, const ThrustOptions& options) {
  result.parameters.push_back(*over_files(files, "kT", "N s^2/rad^2", thrust_fit, result.warnings));
  if (auto kQ = over_files(files, "kQ", "N m s^2/rad^2", torque_fit, result.warnings)) {
    result.parameters.push_back(*kQ);
    const double rho = std::clamp(
        thrust_torque_covariance(files) / (result.find("kT")->std * result.find("kQ")->std), -1.0, 1.0);
    result.correlation = {{"kT", "kQ"}, Eigen::Matrix2d{{1.0, rho}, {rho, 1.0}}};
  }
  add_rotor(result, options, result.correlation.of("kT", "kQ"));
  add_curve(result, files);
  add_motor(result, files);
}

}  // namespace ident
