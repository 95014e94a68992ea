// Restricted likelihood of level and colour of every noise group.
//
// With W the whitening of all rows, M = (W J)'(W J) and b = (W J)' W r at the solution,
//
//     -2 l = sum log(variance) + log |M| + |W r|^2 - b' M^-1 b                                        (1)
//
// [Patterson, Thompson 1971]. Unlike plain maximum likelihood it knows that the unknowns took their share of
// the residuals, without which level and autocorrelation come out too small and intervals too short.
#pragma once

#include "ident/lsq/least_squares_lag_products.h"
#include "ident/lsq/least_squares_noise.h"

namespace ident {

class RestrictedLikelihood {
 public:
  RestrictedLikelihood(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                       std::vector<GroupNoise> start, Eigen::Index longest_order);

  double rows(std::size_t g) const { return products_[g].rows(); }
  /// Rows less the share that the unknowns take of them.
  double freedom(std::size_t g) const;
  bool level_is_free(std::size_t g) const { return !problem_.groups[g].known_sigma && rows(g) > 0.0; }
  const std::vector<GroupNoise>& noise() const { return noise_; }

  void set_colour(std::size_t g, const Colour& colour);
  void set_level(std::size_t g, double sigma) { noise_[g].sigma = sigma; }
  /// The level that maximises (1) with everything else fixed: a fixed point, exact at once for one group.
  void fit_level(std::size_t g);

  Eigen::MatrixXd information() const;  ///< M
  Eigen::VectorXd gradient() const;     ///< b
  double minus_two_log() const;         ///< (1)

 private:
  const LeastSquaresProblem& problem_;
  Eigen::Index unknowns_;
  std::vector<LagProducts> products_;
  std::vector<DecorrelatedSums> sums_;
  std::vector<GroupNoise> noise_;
};

/// Noise that lasts longer than the recording cannot be told from a wrong model: partial autocorrelations
/// stay below 1 - 1/rows. The bound of their atanh.
double largest_atanh(double rows);

/// Density of colours before any data, -2 log of it in the coordinates atanh(partial): about that of [Berger,
/// Yang 1994], 1/sqrt(1 - rho^2) in rho. Keeps the estimate of a short series from the edge, where noise
/// explains any trend.
double minus_two_log_prior(const Eigen::VectorXd& partial);

}  // namespace ident
