// Sums over groups, and the determinants and solutions that (1) needs.
#include "ident/lsq/least_squares_likelihood.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/math.h"

namespace ident {
namespace {

constexpr double kSmallestSigma = 1e-100;

}  // namespace

RestrictedLikelihood::RestrictedLikelihood(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                           std::vector<GroupNoise> start, Eigen::Index longest_order)
    : problem_(problem), unknowns_(rows.J.cols()), noise_(std::move(start)) {
  for (const GroupNoise& group : noise_)
    products_.emplace_back(unknowns_ + 1, std::max(longest_order, group.colour.order()));
  for (const ResidualSeries& s : problem.series) {
    if (s.end <= s.begin) continue;
    Eigen::MatrixXd part(s.end - s.begin, unknowns_ + 1);
    part << rows.J.middleRows(s.begin, s.end - s.begin), rows.r.segment(s.begin, s.end - s.begin);
    products_[static_cast<std::size_t>(s.group)].add(
        part, {rows.missing.begin() + s.begin, rows.missing.begin() + s.end});
  }
  for (std::size_t g = 0; g < noise_.size(); ++g) sums_.push_back(products_[g].sums(noise_[g].colour));
}

double RestrictedLikelihood::freedom(std::size_t g) const {
  if (unknowns_ == 0) return rows(g);
  const Eigen::LLT<Eigen::MatrixXd> M(information());
  return rows(g) - M.solve(sums_[g].JJ).trace() / square(noise_[g].sigma);
}

void RestrictedLikelihood::set_colour(std::size_t g, const Colour& colour) {
  noise_[g].colour = colour;
  sums_[g] = products_[g].sums(colour);
}

Eigen::MatrixXd RestrictedLikelihood::information() const {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
  for (std::size_t g = 0; g < sums_.size(); ++g) M += sums_[g].JJ / square(noise_[g].sigma);
  return M;
}

Eigen::VectorXd RestrictedLikelihood::gradient() const {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns_);
  for (std::size_t g = 0; g < sums_.size(); ++g) b += sums_[g].Jr / square(noise_[g].sigma);
  return b;
}

double RestrictedLikelihood::minus_two_log() const {  // (1)
  double value = 0.0;
  for (std::size_t g = 0; g < sums_.size(); ++g) {
    const double variance = square(noise_[g].sigma);
    value += rows(g) * std::log(variance) + sums_[g].log_variances + sums_[g].rr / variance;
  }
  if (unknowns_ == 0) return value;
  const Eigen::VectorXd b = gradient();
  const Eigen::LLT<Eigen::MatrixXd> M(information());
  return value + 2.0 * M.matrixLLT().diagonal().array().log().sum() - b.dot(M.solve(b));
}

void RestrictedLikelihood::fit_level(std::size_t g) {
  if (!level_is_free(g)) return;
  for (int i = 0; i < (sums_.size() == 1 ? 1 : 3); ++i) {
    double left = sums_[g].rr, taken = 0.0;
    if (unknowns_ > 0) {
      const Eigen::LLT<Eigen::MatrixXd> M(information());
      const Eigen::VectorXd step = -M.solve(gradient());
      left += 2.0 * sums_[g].Jr.dot(step) + step.dot(sums_[g].JJ * step);
      taken = M.solve(sums_[g].JJ).trace() / square(noise_[g].sigma);
    }
    const double variance = std::max(left, 0.0) / std::max(rows(g) - taken, 1e-3 * rows(g));
    noise_[g].sigma = std::max(std::sqrt(variance), kSmallestSigma);
  }
}

double largest_atanh(double rows) { return 0.5 * std::log(std::max(2.0 * rows, 4.0)); }

double minus_two_log_prior(const Eigen::VectorXd& partial) {
  // cosh(atanh(p)) = 1/sqrt(1 - p^2)
  return -(1.0 - partial.array().square()).log().sum();
}

}  // namespace ident
