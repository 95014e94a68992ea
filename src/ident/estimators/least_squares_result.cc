// What a caller asks a finished fit: intervals of unknowns and of functions of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ident/estimators/least_squares.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

constexpr double kIdentifiableBelow = 0.1;  // standard deviation relative to the value, without a prior

Eigen::VectorXd unit_gradient(const LeastSquaresFit& fit, Eigen::Index i) {
  return Eigen::VectorXd::Unit(fit.x.size(), i);
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
  const auto constants = static_cast<Eigen::Index>(covariance_slopes.size());
  const double variance = gradient.dot(determined_covariance * gradient);
  Eigen::VectorXd slope(constants);
  for (Eigen::Index k = 0; k < constants; ++k)
    slope(k) = gradient.dot(covariance_slopes[static_cast<std::size_t>(k)] * gradient);
  const double spread = constants > 0 ? slope.dot(noise_constants_covariance * slope) : 0.0;
  if (!(spread > 0.0)) return std::numeric_limits<double>::infinity();
  return std::clamp(2.0 * variance * variance / spread, 1.0, std::max(1.0, degrees_of_freedom));
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

}  // namespace ident
