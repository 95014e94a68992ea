// What a caller asks a finished fit: intervals of unknowns and of functions of them.
#include "ident/lsq/least_squares_result.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kIdentifiableBelow = 0.1;  // standard deviation relative to the value, without a prior

Eigen::VectorXd unit_gradient(const LeastSquaresFit& fit, Eigen::Index i) {
  return Eigen::VectorXd::Unit(fit.x.size(), i);
}

/// Half width of the central 95 % of normal distributions, each with weight, mean and standard deviation.
struct Normal {
  double weight, mean, std;
};
double half_width_95(const std::vector<Normal>& parts) {
  double low = 0.0, high = 0.0;
  for (const Normal& p : parts) high = std::max(high, std::fabs(p.mean) + 10.0 * p.std);
  for (int i = 0; i < 60; ++i) {
    const double h = 0.5 * (low + high);
    double inside = 0.0;
    for (const Normal& p : parts)
      inside += p.weight * (normal_cdf((h - p.mean) / p.std) - normal_cdf((-h - p.mean) / p.std));
    (inside < 0.95 ? low : high) = h;
  }
  return 0.5 * (low + high);
}

/// The degrees of freedom at which t95 has a value; infinite where that is below the normal one.
double dof_with_t95(double quantile) {
  double low = 0.0, high = std::log(1e6);
  if (quantile <= t95(std::exp(high))) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 16; ++i) {
    const double middle = 0.5 * (low + high);
    (t95(std::exp(middle)) > quantile ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

Eigen::Index LeastSquaresFit::index(const std::string& name) const {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) throw std::out_of_range("no unknown is called " + name);
  return at - names.begin();
}

double LeastSquaresFit::std(const std::string& name) const {
  return std_of(unit_gradient(*this, index(name)));
}

double LeastSquaresFit::std_of(const Eigen::VectorXd& gradient) const {
  for (Eigen::Index k = 0; k < undetermined.cols(); ++k) {
    double along = 0.0, size = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const bool positive = coordinates[static_cast<std::size_t>(i)] == Coordinate::positive;
      const double part = gradient(i) * undetermined(i, k) * (positive ? x(i) : 1.0);
      along += part;
      size += std::fabs(part);
    }
    if (std::fabs(along) > 1e-6 * size) return std::numeric_limits<double>::infinity();
  }
  return std::sqrt(std::max(0.0, gradient.dot(determined_covariance * gradient)));
}

double LeastSquaresFit::dof_of(const Eigen::VectorXd& gradient) const {
  if (!noise_draws.empty()) {
    const Eigen::VectorXd g = directions.transpose() * gradient;
    std::vector<Normal> parts;
    for (const NoiseDraw& draw : noise_draws)
      parts.push_back({draw.weight, g.dot(draw.shift), std::sqrt(g.dot(draw.covariance * g))});
    const double variance = gradient.dot(determined_covariance * gradient);
    return variance > 0.0 ? dof_with_t95(half_width_95(parts) / std::sqrt(variance))
                          : std::numeric_limits<double>::infinity();
  }
  const auto constants = static_cast<Eigen::Index>(covariance_slopes.size());
  const double variance = gradient.dot(determined_covariance * gradient);
  Eigen::VectorXd slope(constants);
  for (Eigen::Index k = 0; k < constants; ++k)
    slope(k) = gradient.dot(covariance_slopes[static_cast<std::size_t>(k)] * gradient);
  const double spread = constants > 0 ? slope.dot(noise_constants_covariance * slope) : 0.0;
  if (!(spread > 0.0)) return std::numeric_limits<double>::infinity();
  return std::clamp(2.0 * variance * variance / spread, 1.0, std::max(1.0, degrees_of_freedom));
}

double LeastSquaresFit::p_of_zero(const std::vector<Eigen::Index>& unknowns) const {
  const auto q = static_cast<Eigen::Index>(unknowns.size());
  Eigen::VectorXd value(q);
  Eigen::MatrixXd select = Eigen::MatrixXd::Zero(q, x.size());
  double dof = std::numeric_limits<double>::infinity();
  for (Eigen::Index a = 0; a < q; ++a) {
    const Eigen::Index i = unknowns[static_cast<std::size_t>(a)];
    value(a) = x(i);
    select(a, i) = 1.0;
    if (!std::isfinite(covariance(i, i))) return kNaN;
    if (noise_draws.empty()) dof = std::min(dof, dof_of(unit_gradient(*this, i)));
  }
  const auto distance = [&](const Eigen::VectorXd& v, const Eigen::MatrixXd& C) {
    return v.dot(C.ldlt().solve(v));
  };
  if (noise_draws.empty()) {
    const double f = distance(value, select * covariance * select.transpose()) / static_cast<double>(q);
    return 1.0 - f_cdf(f, static_cast<double>(q), dof);
  }
  const Eigen::MatrixXd into = select * directions;
  double p = 0.0;
  for (const NoiseDraw& draw : noise_draws)
    p += draw.weight *
         (1.0 - chi2_cdf(distance(value + into * draw.shift, into * draw.covariance * into.transpose()),
                         static_cast<double>(q)));
  return p;
}

Parameter derived_parameter(const LeastSquaresFit& fit, std::string name, double value,
                            const Eigen::VectorXd& gradient, std::string unit, std::string source) {
  Parameter p{.name = std::move(name), .value = value, .std = fit.std_of(gradient), .unit = std::move(unit)};
  p.source = std::move(source);
  const double half = t95(fit.dof_of(gradient)) * p.std;
  p.ci95 = {value - half, value + half};
  p.identifiable = p.std < kIdentifiableBelow * std::fabs(value);
  const double naive = gradient.cwiseAbs2().dot(fit.naive_covariance.diagonal());
  if (std::isfinite(naive))
    p.naive_std = std::sqrt(std::max(0.0, gradient.dot(fit.naive_covariance * gradient)));
  return p;
}

Parameter fitted_parameter(const LeastSquaresFit& fit, const std::string& name, std::string unit,
                           std::string source) {
  const Eigen::Index i = fit.index(name);
  const Eigen::VectorXd gradient = unit_gradient(fit, i);
  Parameter p = derived_parameter(fit, name, fit.x(i), gradient, std::move(unit), std::move(source));
  if (fit.coordinates[static_cast<std::size_t>(i)] == Coordinate::positive) {
    const double factor = std::exp(t95(fit.dof_of(gradient)) * p.std / p.value);
    p.ci95 = {p.value / factor, p.value * factor};
  }
  return p;
}

ResidualFunction linear_residuals(Eigen::MatrixXd A, Eigen::VectorXd y) {
  return
      [A = std::move(A), y = std::move(y)](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
        r.noalias() = A * x - y;
        if (J) *J = A;
        return true;
      };
}

Correlation fitted_correlation(const LeastSquaresFit& fit, std::vector<std::string> names) {
  std::vector<Eigen::Index> at;
  for (const std::string& name : names) at.push_back(fit.index(name));
  const Eigen::MatrixXd C = fit.determined_covariance(at, at);
  const Eigen::VectorXd s =
      C.diagonal().unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
  Correlation out{std::move(names), s.asDiagonal() * C * s.asDiagonal()};
  out.matrix.diagonal().setOnes();
  return out;
}

}  // namespace ident
