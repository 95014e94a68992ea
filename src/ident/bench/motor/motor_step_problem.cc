// Responses of all records put together: prediction, Jacobian, linear starts, names of the unknowns.
#include "ident/bench/motor/motor_step_problem.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "ident/bench/motor/motor_step_edges.h"
#include "ident/lsq/least_squares_fit.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr double kNoDeadTime = 1e-9;                      // s: a dead time of zero is one known that well
constexpr double kUsualOmega = 30.0, kOmegaSpread = 3.0;  // weak prior: log(omega_m) = log(30) +- 3

Eigen::Index count_coefficients(StaticCurve curve, const std::vector<StepRecord>& records) {
  if (curve == StaticCurve::proportional) return 1;
  if (curve == StaticCurve::line) return 2;
  if (curve == StaticCurve::cubic) return 4;
  std::size_t edges = 0;
  for (const StepRecord& record : records) edges += record.edges.size();
  return static_cast<Eigen::Index>(edges);
}

/// One row for each edge: delta, 1, delta^2, delta^3, or one column for each plateau.
Eigen::MatrixXd inputs_of(const StepRecord& record, StaticCurve curve, Eigen::Index coefficients) {
  const auto edges = static_cast<Eigen::Index>(record.edges.size());
  if (curve == StaticCurve::plateaus) return Eigen::MatrixXd::Identity(edges, edges);
  Eigen::MatrixXd inputs(edges, coefficients);
  for (Eigen::Index e = 0; e < edges; ++e) {
    const double delta = record.edges[static_cast<std::size_t>(e)].delta;
    for (Eigen::Index k = 0; k < coefficients; ++k)
      inputs(e, k) = k == 0 ? delta : k == 1 ? 1.0 : std::pow(delta, static_cast<double>(k));
  }
  return inputs;
}

}  // namespace

MotorProblem::MotorProblem(const std::vector<StepRecord>& records, const MotorFreedom& freedom,
                           const std::vector<bool>& left_out, const std::vector<bool>& suspects)
    : records_(records),
      freedom_(freedom),
      coefficients_(count_coefficients(freedom.curve, records)),
      suspects_(suspects) {
  Eigen::Index plateau = 0;
  for (const StepRecord& record : records) {
    inputs_.push_back(inputs_of(record, freedom.curve, coefficients_));
    first_coefficient_.push_back(freedom.curve == StaticCurve::plateaus ? plateau : 0);
    first_shift_.push_back(steps_);
    plateau += static_cast<Eigen::Index>(record.edges.size());
    steps_ += static_cast<Eigen::Index>(record.edges.size()) - 1;
    samples_ += static_cast<Eigen::Index>(record.rows());
  }
  measured_.resize(samples_);
  Eigen::Index row = 0;
  for (const StepRecord& record : records)
    for (const double Omega : record.Omega) measured_(row++) = Omega;
  weights_ = Eigen::VectorXd::Ones(samples_);
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i]) weights_(static_cast<Eigen::Index>(i)) = 0.0;
}

MotorShape MotorProblem::shape(const Eigen::VectorXd& x) const {
  const Eigen::Index s = shape_at();
  return {x(s), x(s + 1), x(s + 2), freedom_.directions == SpinDirections::apart ? x(s + 3) : 1.0};
}

StepRecord MotorProblem::moved(const Eigen::VectorXd& x, std::size_t k) const {
  if (shifts() == 0) return records_[k];
  return with_shifted_edges(records_[k], x.segment(shift_at(k), inputs_[k].rows() - 1));
}

std::string MotorProblem::name(Eigen::Index i) const {
  static const std::vector<std::string> polynomial = {"km", "Omega_0", "k2", "k3"};
  static const std::vector<std::string> shape = {"omega_m", "zeta_m", "dead_time", "down_ratio"};
  if (i < shape_at())
    return freedom_.curve == StaticCurve::plateaus ? fmt::format("level_{}", i)
                                                   : polynomial[static_cast<std::size_t>(i)];
  if (i < shape_at() + shape_size()) return shape[static_cast<std::size_t>(i - shape_at())];
  if (i < shift_at(0)) return fmt::format("start_{}", i - shape_at() - shape_size());
  return fmt::format("shift_{}", i - shift_at(0));
}

/// The derivatives need the model's speed only, one signal; a column for each coefficient is linear in them.
void MotorProblem::predict(const Eigen::VectorXd& x, Eigen::VectorXd& Omega, Eigen::MatrixXd* J) const {
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(records_[k].rows());
    const Eigen::Index inputs = inputs_[k].cols();
    const Eigen::VectorXd command = inputs_[k] * x.segment(first_coefficient_[k], inputs);
    const Eigen::Vector3d c(1.0, x(start_at(k)), x(start_at(k) + 1));
    const Eigen::Index steps = inputs_[k].rows() - 1;
    const StepRecord record = moved(x, k);
    const MotorResponses sum = motor_responses(record, command, shape(x), J ? Slopes::yes : Slopes::no);
    Omega.segment(row, n) = sum.value * c;  // (1)
    if (J) {
      for (Eigen::Index s = 0; s < shape_size(); ++s)
        J->block(row, shape_at() + s, n, 1) = sum.slope[static_cast<std::size_t>(s)] * c;
      J->block(row, start_at(k), n, 2) = sum.value.rightCols(2);
      if (shifts() > 0)
        J->block(row, shift_at(k), n, steps) = edge_time_slopes(record, command, c.tail<2>(), shape(x));
      const MotorResponses each = motor_responses(record, inputs_[k], shape(x), Slopes::no);
      J->block(row, first_coefficient_[k], n, inputs) = each.value.leftCols(inputs);
    }
    row += n;
  }
}

MotorProblem::Start MotorProblem::start(const MotorShape& shape, const std::vector<double>& shifted) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns());
  const Eigen::Index s = shape_at();
  x.segment(s, 3) << shape.omega_m, shape.zeta_m, shape.dead_time;
  if (freedom_.directions == SpinDirections::apart) x(s + 3) = shape.down_ratio;
  for (Eigen::Index e = 0; e < shifts() && !shifted.empty(); ++e)
    x(shift_at(0) + e) = shifted[static_cast<std::size_t>(e)];
  Eigen::MatrixXd linear = Eigen::MatrixXd::Zero(samples_, unknowns());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(records_[k].rows());
    const Eigen::Index inputs = inputs_[k].cols();
    const MotorResponses r = motor_responses(moved(x, k), inputs_[k], shape, Slopes::no);
    linear.block(row, first_coefficient_[k], n, inputs) = r.value.leftCols(inputs);
    linear.block(row, start_at(k), n, 2) = r.value.rightCols(2);
    row += n;
  }
  // A start only: the columns of the shape are zero, and plateaus of few rows may be nearly so.
  linear = weights_.asDiagonal() * linear;
  const Eigen::VectorXd measured = weights_.cwiseProduct(measured_);
  const Eigen::MatrixXd normal = linear.transpose() * linear;
  const Eigen::VectorXd c = normal.completeOrthogonalDecomposition().solve(linear.transpose() * measured);
  for (Eigen::Index i = 0; i < shift_at(0); ++i)
    if (i < s || i >= s + shape_size()) x(i) = c(i);
  return {x, linear * c - measured};
}

LeastSquaresProblem MotorProblem::problem(const std::vector<Eigen::VectorXd>& starts) const {
  const Eigen::Index zero = freedom_.dead_time == DeadTime::zero ? 1 : 0, known = 1 + zero + shifts();
  LeastSquaresProblem p{.residuals = samples_ + known};
  for (Eigen::Index i = 0; i < unknowns(); ++i) {
    const bool positive = i >= shape_at() && i < shape_at() + shape_size() && i != shape_at() + 2;
    p.unknowns.push_back({name(i), starts.front()(i), positive ? Coordinate::positive : Coordinate::real});
  }
  p.more_starts.assign(starts.begin() + 1, starts.end());
  p.groups = {{.name = "omega"},
              {.name = "prior", .known_sigma = 1.0, .in_time_order = false, .may_have_outliers = false}};
  Eigen::Index row = 0;
  for (const StepRecord& record : records_) {
    p.series.push_back({.begin = row, .end = row + static_cast<Eigen::Index>(record.rows()), .group = 0});
    row = p.series.back().end;
  }
  p.series.push_back({.begin = row, .end = row + known, .group = 1});
  p.suspects = suspects_;
  if (!p.suspects.empty()) p.suspects.resize(static_cast<std::size_t>(p.residuals), false);
  p.evaluate = [this, zero](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    Eigen::VectorXd Omega(samples_);
    predict(x, Omega, J);
    r.head(samples_) = weights_.cwiseProduct(Omega - measured_);
    if (J) J->topRows(samples_) = weights_.asDiagonal() * J->topRows(samples_);
    // A motor without inertia is as likely to the data as one of first order: the prior ends the search.
    r(samples_) = std::log(x(shape_at()) / kUsualOmega) / kOmegaSpread;
    if (J) (*J)(samples_, shape_at()) = 1.0 / (kOmegaSpread * x(shape_at()));
    for (Eigen::Index e = 0; e < shifts(); ++e) {
      r(samples_ + 1 + zero + e) = x(shift_at(0) + e) / freedom_.edge_scatter;
      if (J) (*J)(samples_ + 1 + zero + e, shift_at(0) + e) = 1.0 / freedom_.edge_scatter;
    }
    if (zero > 0) {
      r(samples_ + 1) = x(shape_at() + 2) / kNoDeadTime;
      if (J) (*J)(samples_ + 1, shape_at() + 2) = 1.0 / kNoDeadTime;
    }
    return true;
  };
  return p;
}

Eigen::MatrixXd MotorProblem::squares(const Eigen::VectorXd& x) const {
  Eigen::VectorXd Omega(samples_);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(samples_, unknowns());
  predict(x, Omega, &J);
  const Eigen::MatrixXd rows = weights_.cwiseProduct(Omega - measured_).asDiagonal() * J;
  return rows.transpose() * rows;
}

MotorFit MotorProblem::solve(const std::vector<Eigen::VectorXd>& starts,
                             const LeastSquaresOptions& options) const {
  MotorFit result{.curve = freedom_.curve, .fit = solve_least_squares(problem(starts), options)};
  result.shape = shape(result.fit.x);
  result.dead_time = fitted_parameter(result.fit, "dead_time", "s", "motor");
  Eigen::VectorXd Omega(samples_);
  predict(result.fit.x, Omega, nullptr);
  result.predicted.assign(Omega.begin(), Omega.end());
  result.edge_scatter = freedom_.edge_scatter;
  for (Eigen::Index e = 0; e < shifts(); ++e) result.shifts.push_back(result.fit.x(shift_at(0) + e));
  for (Eigen::Index i = 0; i < samples_; ++i) {
    if (weights_(i) > 0.0) continue;
    result.fit.rejected[static_cast<std::size_t>(i)] = true;
    result.fit.standardized(i) = kNaN;
  }
  return result;
}

}  // namespace ident
