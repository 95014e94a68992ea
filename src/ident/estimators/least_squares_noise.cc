// Restricted likelihood of level and colour, maximised one constant at a time.
//
// With W the whitening of all rows, M = (W J)'(W J) and b = (W J)' W r at the solution,
//
//     -2 l = sum log(variance) + log |M| + |W r|^2 - b' M^-1 b                                        (1)
//
// [Patterson, Thompson 1971]. Unlike plain maximum likelihood it knows that the unknowns took their share of
// the residuals, without which level and autocorrelation come out too small and intervals too short.
#include "ident/estimators/least_squares_noise.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "ident/estimators/least_squares_lag_products.h"

namespace ident {
namespace {

constexpr double kLargestAtanh = 4.0;  // partial autocorrelation 0.9993
constexpr Eigen::Index kFewestRowsForColour = 20;
constexpr double kSmallestSigma = 1e-100;

/// Smallest value of f between low and high, by golden section and parabolas [Brent 1973].
template <typename Function>
double minimum(const Function& f, double low, double high, double start, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double x = start, w = start, v = start, fx = f(start), fw = fx, fv = fx, step = 0.0, last = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (std::fabs(x - middle) <= 2.0 * tolerance - 0.5 * (high - low)) break;
    bool parabola = false;
    if (std::fabs(last) > tolerance) {
      const double r = (x - w) * (fx - fv), q = (x - v) * (fx - fw);
      const double p = (x - v) * q - (x - w) * r, d = 2.0 * (q - r);
      const double move = d != 0.0 ? -p / d : 0.0;
      if (d != 0.0 && std::fabs(move) < 0.5 * std::fabs(last) && x + move > low && x + move < high) {
        last = step;
        step = move;
        parabola = true;
      }
    }
    if (!parabola) {
      last = (x < middle ? high : low) - x;
      step = golden * last;
    }
    const double u = x + (std::fabs(step) >= tolerance ? step : std::copysign(tolerance, step));
    const double fu = f(u);
    if (fu <= fx) {
      (u < x ? high : low) = x;
      v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
    } else {
      (u < x ? low : high) = u;
      if (fu <= fw || w == x)
        v = w, fv = fw, w = u, fw = fu;
      else if (fu <= fv || v == x || v == w)
        v = u, fv = fu;
    }
  }
  return x;
}

class RestrictedLikelihood {
 public:
  RestrictedLikelihood(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                       std::vector<GroupNoise> start, Eigen::Index longest_order)
      : problem_(problem), unknowns_(rows.J.cols()), noise(std::move(start)) {
    for (std::size_t g = 0; g < noise.size(); ++g)
      products_.emplace_back(unknowns_ + 1, std::max(longest_order, noise[g].colour.order()));
    for (const ResidualSeries& s : problem.series) {
      if (s.end <= s.begin) continue;
      Eigen::MatrixXd part(s.end - s.begin, unknowns_ + 1);
      part << rows.J.middleRows(s.begin, s.end - s.begin), rows.r.segment(s.begin, s.end - s.begin);
      products_[static_cast<std::size_t>(s.group)].add(
          part, {rows.missing.begin() + s.begin, rows.missing.begin() + s.end});
    }
    for (std::size_t g = 0; g < noise.size(); ++g) sums_.push_back(products_[g].sums(noise[g].colour));
  }

  double rows(std::size_t g) const { return products_[g].rows(); }
  bool level_is_free(std::size_t g) const { return !problem_.groups[g].known_sigma && rows(g) > 0.0; }

  void set_colour(std::size_t g, const Colour& colour) {
    noise[g].colour = colour;
    sums_[g] = products_[g].sums(colour);
  }

  Eigen::MatrixXd information() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
    for (std::size_t g = 0; g < sums_.size(); ++g) M += sums_[g].JJ / square(noise[g].sigma);
    return M;
  }

  double minus_two_log() const {  // (1)
    double value = 0.0;
    Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns_);
    for (std::size_t g = 0; g < sums_.size(); ++g) {
      const double variance = square(noise[g].sigma);
      value += rows(g) * std::log(variance) + sums_[g].log_variances + sums_[g].rr / variance;
      b += sums_[g].Jr / variance;
    }
    if (b.size() == 0) return value;
    const Eigen::LLT<Eigen::MatrixXd> M(information());
    return value + 2.0 * M.matrixLLT().diagonal().array().log().sum() - b.dot(M.solve(b));
  }

  /// The level that maximises (1) with everything else fixed: a fixed point, exact at once for one group.
  void fit_level(std::size_t g) {
    if (!level_is_free(g)) return;
    for (int i = 0; i < (sums_.size() == 1 ? 1 : 3); ++i) {
      double left = sums_[g].rr, taken = 0.0;
      if (unknowns_ > 0) {
        Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns_);
        for (std::size_t k = 0; k < sums_.size(); ++k) b += sums_[k].Jr / square(noise[k].sigma);
        const Eigen::LLT<Eigen::MatrixXd> M(information());
        const Eigen::VectorXd step = -M.solve(b);
        left += 2.0 * sums_[g].Jr.dot(step) + step.dot(sums_[g].JJ * step);
        taken = M.solve(sums_[g].JJ).trace() / square(noise[g].sigma);
      }
      const double variance = std::max(left, 0.0) / std::max(rows(g) - taken, 1e-3 * rows(g));
      noise[g].sigma = std::max(std::sqrt(variance), kSmallestSigma);
    }
  }

 private:
  static double square(double v) { return v * v; }

  const LeastSquaresProblem& problem_;
  Eigen::Index unknowns_;
  std::vector<LagProducts> products_;
  std::vector<DecorrelatedSums> sums_;

 public:
  std::vector<GroupNoise> noise;
};

/// Level and colour of the given order, one partial autocorrelation after the other.
void fit_colour(RestrictedLikelihood& likelihood, std::size_t g, Eigen::VectorXd partial) {
  for (int round = 0; round < 6; ++round) {
    const Eigen::VectorXd before = partial;
    for (Eigen::Index k = 0; k < partial.size(); ++k) {
      const auto cost = [&](double z) {
        partial(k) = std::tanh(z);
        likelihood.set_colour(g, Colour(partial));
        likelihood.fit_level(g);
        return likelihood.minus_two_log();
      };
      cost(minimum(cost, -kLargestAtanh, kLargestAtanh, std::atanh(partial(k)), 2e-4));
    }
    if (partial.size() < 2 || (partial - before).cwiseAbs().maxCoeff() < 1e-3) break;
  }
}

void fit_group(RestrictedLikelihood& likelihood, std::size_t g, int max_order) {
  const double n = likelihood.rows(g);
  GroupNoise best = likelihood.noise[g];
  double best_criterion = 0.0;
  Eigen::VectorXd partial(0);
  for (int order = 0; order <= max_order; ++order) {
    if (order > 0) {
      const Eigen::VectorXd shorter = partial;
      partial.resize(order);
      partial << shorter, 0.0;
    }
    likelihood.set_colour(g, Colour(partial));
    likelihood.fit_level(g);
    if (order > 0) fit_colour(likelihood, g, partial);
    partial = likelihood.noise[g].colour.partial();
    const double criterion = likelihood.minus_two_log() + order * std::log(std::max(n, 2.0));
    if (order == 0 || criterion < best_criterion) {
      best = likelihood.noise[g];
      best_criterion = criterion;
    } else if (order > best.colour.order() + 1) {
      break;
    }
  }
  likelihood.set_colour(g, best.colour);
  likelihood.noise[g].sigma = best.sigma;
}

}  // namespace

double whiten(const std::vector<ResidualSeries>& series, const std::vector<GroupNoise>& noise,
              const std::vector<bool>& missing, Eigen::MatrixXd& rows) {
  double log_variances = 0.0;
  for (const ResidualSeries& s : series) {
    const GroupNoise& group = noise[static_cast<std::size_t>(s.group)];
    log_variances += group.colour.whiten(s.begin, s.end, missing, rows);
    rows.middleRows(s.begin, s.end - s.begin) /= group.sigma;
    log_variances +=
        2.0 * std::log(group.sigma) *
        static_cast<double>(std::count(missing.begin() + s.begin, missing.begin() + s.end, false));
  }
  return log_variances;
}

std::vector<GroupNoise> estimate_noise(const LeastSquaresProblem& problem, int max_colour_order,
                                       const LinearisedRows& rows, std::vector<GroupNoise> noise) {
  RestrictedLikelihood likelihood(problem, rows, std::move(noise), max_colour_order);
  const int rounds = problem.groups.size() == 1 ? 1 : 4;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t g = 0; g < problem.groups.size(); ++g) {
      if (!likelihood.level_is_free(g)) continue;
      const bool coloured = problem.groups[g].in_time_order &&
                            likelihood.rows(g) >= static_cast<double>(kFewestRowsForColour + rows.J.cols());
      if (round == 0)
        fit_group(likelihood, g, coloured ? max_colour_order : 0);
      else
        fit_colour(likelihood, g, likelihood.noise[g].colour.partial());
      likelihood.fit_level(g);
    }
  }
  return likelihood.noise;
}

NoiseSensitivity noise_sensitivity(const LeastSquaresProblem& problem, const LinearisedRows& rows,
                                   const std::vector<GroupNoise>& noise) {
  const Eigen::Index unknowns = rows.J.cols();
  RestrictedLikelihood likelihood(problem, rows, noise, 0);
  const auto covariance = [&] {
    return Eigen::MatrixXd(
        likelihood.information().llt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns)));
  };
  NoiseSensitivity result{.covariance = covariance()};
  for (std::size_t g = 0; g < noise.size(); ++g) {
    if (!likelihood.level_is_free(g)) continue;
    const Eigen::Index constants = 1 + noise[g].colour.order();
    const double h = std::clamp(0.3 / std::sqrt(likelihood.rows(g)), 1e-3, 0.1);
    // Constants of this group: log variance of the innovations, atanh of the partial autocorrelations.
    const auto set = [&](const Eigen::VectorXd& change) {
      Eigen::VectorXd partial = noise[g].colour.partial();
      for (Eigen::Index k = 0; k < partial.size(); ++k)
        partial(k) = std::tanh(std::atanh(partial(k)) + change(k + 1));
      if (partial.size() > 0) likelihood.set_colour(g, Colour(partial));
      likelihood.noise[g].sigma = noise[g].sigma * std::exp(0.5 * change(0));
    };
    const auto l = [&](const Eigen::VectorXd& change) {
      set(change);
      return -0.5 * likelihood.minus_two_log();
    };
    const auto unit = [&](Eigen::Index k) {
      return Eigen::VectorXd(h * Eigen::VectorXd::Unit(constants, k));
    };
    Eigen::MatrixXd H(constants, constants);
    const double l0 = l(Eigen::VectorXd::Zero(constants));
    for (Eigen::Index a = 0; a < constants; ++a) {
      H(a, a) = -(l(unit(a)) + l(-unit(a)) - 2.0 * l0) / (h * h);
      for (Eigen::Index b = 0; b < a; ++b)
        H(a, b) = H(b, a) =
            -(l(unit(a) + unit(b)) - l(unit(a) - unit(b)) - l(unit(b) - unit(a)) + l(-unit(a) - unit(b))) /
            (4.0 * h * h);
      set(unit(a));
      const Eigen::MatrixXd above = covariance();
      set(-unit(a));
      result.slopes.push_back((above - covariance()) / (2.0 * h));
    }
    set(Eigen::VectorXd::Zero(constants));
    // A constant on the edge of its range has no maximum there: it counts as known to about 1.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
    const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(0.25).cwiseInverse();
    const Eigen::MatrixXd block =
        eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
    const Eigen::Index before = result.constants_covariance.rows();
    result.constants_covariance.conservativeResizeLike(
        Eigen::MatrixXd::Zero(before + constants, before + constants));
    result.constants_covariance.block(before, before, constants, constants) = block;
  }
  return result;
}

}  // namespace ident
