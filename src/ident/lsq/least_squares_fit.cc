// From residuals to an estimate: robust start, outliers and noise in turn with the solution, then
// uncertainty.
#include "ident/lsq/least_squares_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares.h"
#include "ident/lsq/least_squares_minimise.h"
#include "ident/lsq/least_squares_noise.h"
#include "ident/lsq/least_squares_uncertainty.h"

namespace ident {
namespace {

constexpr int kMostRounds = 12;
constexpr int kFewestBeyond = 3;  // rows beyond the unknowns that outliers leave

/// Deviation of a row from what the other rows say, against the noise of the other rows.
double deletion_t(double error, double leverage, double dof, bool is_out_already) {
  if (is_out_already) return error / std::sqrt(1.0 + leverage);
  const double inner = error / std::sqrt(std::max(1.0 - leverage, 1e-6));
  if (!std::isfinite(dof)) return inner;
  const double left = (dof - square(inner)) / std::max(dof - 1.0, 1.0);
  return left > 0.0 ? inner / std::sqrt(left) : std::numeric_limits<double>::infinity();
}

/// The problem with its defaults filled in and checked.
LeastSquaresProblem completed(LeastSquaresProblem problem) {
  if (problem.groups.empty()) problem.groups.push_back({});
  if (problem.series.empty()) problem.series.push_back({0, problem.residuals, 0});
  Eigen::Index covered = 0;
  for (const ResidualSeries& series : problem.series) covered += series.end - series.begin;
  if (covered != problem.residuals)
    throw std::logic_error("the series of residuals do not cover all of them once");
  return problem;
}

class Fitter {
 public:
  Fitter(const LeastSquaresProblem& problem, const LeastSquaresOptions& options)
      : problem_(problem),
        options_(options),
        rejected_(static_cast<std::size_t>(problem.residuals), false),
        noise_(problem.groups.size()),
        floor_(problem.groups.size(), 0.0) {}

  LeastSquaresFit run() {
    start();
    // One gross error would else widen the noise by so much that it is none.
    if (options_.robust && !problem_.suspects.empty()) rejected_ = problem_.suspects;
    bool search_order = true;
    for (int round = 0; round < kMostRounds; ++round) {
      const LinearisedRows rows = linearised();
      update_noise(rows, search_order);
      const bool changed = options_.robust && find_outliers(rows);
      search_order = changed || round < 1;
      const Eigen::VectorXd before = x_;
      solve(Effort::coarse);
      if (!changed && settled(rows, before)) break;
    }
    solve(Effort::polish);
    update_noise(linearised(), false);
    return uncertainty();
  }

 private:
  using Rows = std::vector<Eigen::Index>;

  Rows rows_of(std::size_t group) const {
    Rows rows;
    for (const ResidualSeries& s : problem_.series)
      if (static_cast<std::size_t>(s.group) == group)
        for (Eigen::Index i = s.begin; i < s.end; ++i) rows.push_back(i);
    return rows;
  }

  void update_noise(const LinearisedRows& rows, bool order_is_free) {
    noise_ = estimate_noise(problem_, {options_.max_colour_order, order_is_free}, rows, std::move(noise_));
    for (std::size_t g = 0; g < noise_.size(); ++g) noise_[g].sigma = std::max(noise_[g].sigma, floor_[g]);
  }

  Eigen::VectorXd residuals(const Eigen::VectorXd& x, Eigen::MatrixXd* J = nullptr) const {
    Eigen::VectorXd r(problem_.residuals);
    if (J) J->setZero(problem_.residuals, x.size());
    if (!problem_.evaluate(x, r, J) || !r.allFinite()) r.setConstant(kNaN);
    return r;
  }

  /// Level of each group from residuals, by their median deviation when `robust`.
  void set_levels(const Eigen::VectorXd& r) {
    for (std::size_t g = 0; g < noise_.size(); ++g) {
      const Rows rows = rows_of(g);
      std::vector<double> values;
      for (const Eigen::Index i : rows) values.push_back(r(i));
      double level = options_.robust ? mad_scale(values, 0.0) : root_mean_square(values);
      if (!(level > floor_[g])) level = std::max(1e-3 * root_mean_square(values), floor_[g]);
      const auto n = static_cast<double>(rows.size());
      const auto unknowns = static_cast<double>(problem_.unknowns.size());
      if (options_.robust && n > unknowns) level *= std::sqrt(n / (n - std::min(unknowns, 0.5 * n)));
      noise_[g] = {problem_.groups[g].known_sigma.value_or(level), Colour()};
    }
  }

  /// Rounding error of the predictions: noise is never taken to be less.
  void set_floors(const Eigen::VectorXd& x) {
    Eigen::MatrixXd J;
    const Eigen::VectorXd r = residuals(x, &J);
    const Eigen::VectorXd size = J.cwiseAbs() * x.cwiseAbs() + r.cwiseAbs();
    for (std::size_t g = 0; g < noise_.size(); ++g) {
      std::vector<double> values;
      for (const Eigen::Index i : rows_of(g)) values.push_back(size(i));
      floor_[g] = std::max(1e-14 * root_mean_square(values), 1e-100);
    }
  }

  /// sign(r) sqrt(2 rho(r)) with the pseudo-Huber rho: quadratic near zero, linear for outliers.
  void shape(Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
    for (const ResidualSeries& s : problem_.series) {
      const auto g = static_cast<std::size_t>(s.group);
      const double k = 1.345;
      for (Eigen::Index i = s.begin; i < s.end; ++i) {
        const double u = r(i) / noise_[g].sigma;
        double value = u, slope = 1.0;
        if (options_.robust && problem_.groups[g].may_have_outliers && s.may_have_outliers) {
          const double root = std::sqrt(1.0 + square(u / k));
          value = u * std::sqrt(2.0 / (root + 1.0));
          slope = u == 0.0 ? 1.0 : u / (value * root);
        }
        r(i) = value;
        if (J) J->row(i) *= slope / noise_[g].sigma;
      }
    }
  }

  /// Several starts under the same robust cost, the best one refined with its own noise level.
  void start() {
    Eigen::VectorXd first(static_cast<Eigen::Index>(problem_.unknowns.size()));
    for (std::size_t i = 0; i < problem_.unknowns.size(); ++i)
      first(static_cast<Eigen::Index>(i)) = problem_.unknowns[i].start;
    std::vector<Eigen::VectorXd> starts = {first};
    starts.insert(starts.end(), problem_.more_starts.begin(), problem_.more_starts.end());
    const auto usable =
        std::ranges::find_if(starts, [&](const Eigen::VectorXd& x) { return residuals(x).allFinite(); });
    if (usable == starts.end()) throw DataError("no start of the fit gives finite residuals");
    set_levels(residuals(*usable));
    set_floors(*usable);
    const RowTransform robust = [&](Eigen::VectorXd& r, Eigen::MatrixXd* J) { shape(r, J); };
    const Effort wide = options_.search_widely ? Effort::thorough : Effort::polish;
    Minimum best{*usable, std::numeric_limits<double>::infinity()};
    for (const Eigen::VectorXd& x : starts) {
      const Minimum found = minimise(problem_, x, robust, starts.size() > 1 ? Effort::coarse : wide);
      if (found.cost < best.cost) best = found;
    }
    x_ = best.x;
    set_levels(residuals(x_));
    x_ = minimise(problem_, x_, robust, wide).x;
    for (int i = 0; i < 3 && options_.robust; ++i) {
      const Eigen::VectorXd before = x_;
      set_levels(residuals(x_));
      x_ = minimise(problem_, x_, robust, Effort::coarse).x;
      if (((x_ - before).array().abs() <= 1e-4 * x_.array().abs()).all()) break;
    }
    set_levels(residuals(x_));
  }

  /// Residuals and Jacobian in unconstrained coordinates, restricted to what the data determine.
  LinearisedRows linearised() {
    Eigen::MatrixXd J;
    Eigen::VectorXd r = residuals(x_, &J);
    for (std::size_t i = 0; i < problem_.unknowns.size(); ++i)
      if (problem_.unknowns[i].coordinate == Coordinate::positive)
        J.col(static_cast<Eigen::Index>(i)) *= x_(static_cast<Eigen::Index>(i));
    Eigen::MatrixXd weighted = J;
    whiten(problem_.series, noise_, rejected_, weighted);
    for (Eigen::Index i = 0; i < weighted.rows(); ++i)
      if (rejected_[static_cast<std::size_t>(i)]) weighted.row(i).setZero();
    if (!weighted.allFinite())
      throw DataError(
          "the fit ends where its equations have no finite derivative: the data do not fit the model");
    directions_ = determined_directions(weighted, options_.rank_tolerance);
    return {.J = J * directions_.determined, .r = std::move(r), .missing = rejected_};
  }

  /// Prediction errors of all residuals, forwards or backwards in each series, in standard deviations; the
  /// share that the fit itself takes is allowed for.
  Eigen::VectorXd prediction_errors(const LinearisedRows& rows, bool backwards) const {
    const auto flip = [&](auto& column) {
      for (const ResidualSeries& s : problem_.series)
        std::reverse(column.begin() + s.begin, column.begin() + s.end);
    };
    Eigen::MatrixXd r = rows.r;
    std::vector<bool> missing = rejected_;
    if (backwards) {
      Eigen::VectorXd column = r.col(0);
      flip(column);
      r.col(0) = column;
      flip(missing);
    }
    whiten(problem_.series, noise_, missing, r);
    Eigen::VectorXd errors = r.col(0);
    if (backwards) flip(errors);
    return errors;
  }

  /// A residual is an outlier when neither the rows before nor those behind it lead one to expect it.
  bool find_outliers(const LinearisedRows& rows) {
    Eigen::MatrixXd weighted = rows.J;
    whiten(problem_.series, noise_, rejected_, weighted);
    const Eigen::VectorXd leverage = leverages(weighted, rejected_);
    const Eigen::VectorXd forwards = prediction_errors(rows, false),
                          backwards = prediction_errors(rows, true);
    const double used = static_cast<double>(std::ranges::count(rejected_, false));
    const double all = static_cast<double>(rejected_.size());
    const std::vector<bool> before = rejected_;
    for (const ResidualSeries& s : problem_.series) {
      const NoiseGroup& group = problem_.groups[static_cast<std::size_t>(s.group)];
      if (!group.may_have_outliers || !s.may_have_outliers) continue;
      const double dof = group.known_sigma ? std::numeric_limits<double>::infinity()
                                           : std::max(1.0, used - static_cast<double>(rows.J.cols()));
      const double cut = std::max(3.0, t_quantile(1.0 - 0.025 / all, dof));
      for (Eigen::Index i = s.begin; i < s.end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double error = std::min(std::fabs(forwards(i)), std::fabs(backwards(i)));
        rejected_[k] = deletion_t(error, leverage(i), dof, before[k]) > cut;
      }
    }
    // What is left has to tell the unknowns and a level of noise: of three rows each may be the odd one.
    if (std::ranges::count(rejected_, false) < rows.J.cols() + kFewestBeyond)
      rejected_.assign(rejected_.size(), false);
    return rejected_ != before;
  }

  void solve(Effort effort) {
    const RowTransform weights = [&](Eigen::VectorXd& r, Eigen::MatrixXd* J) {
      Eigen::MatrixXd rows(r.size(), 1 + (J ? J->cols() : 0));
      rows.col(0) = r;
      if (J) rows.rightCols(J->cols()) = *J;
      whiten(problem_.series, noise_, rejected_, rows);
      for (Eigen::Index i = 0; i < r.size(); ++i)
        if (rejected_[static_cast<std::size_t>(i)]) rows.row(i).setZero();
      r = rows.col(0);
      if (J) *J = rows.rightCols(J->cols());
    };
    const Minimum found = minimise(problem_, x_, weights, effort);
    if (std::isfinite(found.cost)) x_ = found.x;
  }

  /// Has the solution moved by less than a thousandth of its standard deviation?
  bool settled(const LinearisedRows& rows, const Eigen::VectorXd& before) const {
    Eigen::VectorXd step = x_ - before;
    for (Eigen::Index i = 0; i < step.size(); ++i)
      if (problem_.unknowns[static_cast<std::size_t>(i)].coordinate == Coordinate::positive)
        step(i) = std::log(x_(i) / before(i));
    if (directions_.determined.cols() == 0) return true;  // nothing that could move
    // Components along the determined directions.
    const Eigen::VectorXd along = directions_.determined.colPivHouseholderQr().solve(step);
    Eigen::MatrixXd change = rows.J * along;
    whiten(problem_.series, noise_, rejected_, change);
    double square_length = 0.0;
    for (Eigen::Index i = 0; i < change.rows(); ++i)
      if (!rejected_[static_cast<std::size_t>(i)]) square_length += square(change(i, 0));
    return square_length < 1e-6;
  }

  LeastSquaresFit uncertainty() {
    const LinearisedRows rows = linearised();
    return fit_with_uncertainty(problem_, x_, rows, directions_, noise_);
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  std::vector<bool> rejected_;
  std::vector<GroupNoise> noise_;
  std::vector<double> floor_;
  Eigen::VectorXd x_;
  Directions directions_;
};

}  // namespace

LeastSquaresFit solve_least_squares(const LeastSquaresProblem& problem, const LeastSquaresOptions& options) {
  if (problem.unknowns.empty() || problem.residuals == 0)
    throw DataError("there is nothing to fit: no unknown or no measurement");
  const LeastSquaresProblem complete = completed(problem);
  return Fitter(complete, options).run();
}

}  // namespace ident
