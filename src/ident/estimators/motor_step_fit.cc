// Unknowns, equations and starts of the motor fit, and the choice of the static curve.
#include "ident/estimators/motor_step_fit.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

namespace ident {
namespace {

constexpr double kUsualOmega = 30.0, kOmegaSpread = 3.0;  // weak prior: log(omega_m) = log(30) +- 3
constexpr double kEvident = 6.0;  // less of BIC that a richer static curve has to earn: "strong" evidence
constexpr std::size_t kMostPlateaus = 80, kFewestRowsOfAPlateau = 10;

std::size_t count_levels(const std::vector<StepRecord>& records) {
  std::set<double> levels;
  for (const StepRecord& record : records)
    for (const CommandEdge& edge : record.edges) levels.insert(edge.delta);
  return levels.size();
}

std::size_t count_edges(const std::vector<StepRecord>& records) {
  std::size_t edges = 0;
  for (const StepRecord& record : records) edges += record.edges.size();
  return edges;
}

std::size_t count_rows(const std::vector<StepRecord>& records) {
  std::size_t rows = 0;
  for (const StepRecord& record : records) rows += record.rows();
  return rows;
}

/// Unknowns in the order: coefficients of the static curve, shape, speed and rate at the start of each
/// record.
class MotorProblem {
 public:
  MotorProblem(const std::vector<StepRecord>& records, StaticCurve curve, SpinDirections directions)
      : records_(records), curve_(curve), directions_(directions) {
    coefficients_ = curve == StaticCurve::proportional ? 1
                    : curve == StaticCurve::line       ? 2
                    : curve == StaticCurve::cubic      ? 4
                                                       : static_cast<Eigen::Index>(count_edges(records));
    Eigen::Index plateau = 0;
    for (const StepRecord& record : records) {
      const auto edges = static_cast<Eigen::Index>(record.edges.size());
      const bool own = curve == StaticCurve::plateaus;
      Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(edges, own ? edges : coefficients_);
      for (Eigen::Index e = 0; e < edges; ++e) {
        const double delta = record.edges[static_cast<std::size_t>(e)].delta;
        if (own)
          inputs(e, e) = 1.0;
        else
          for (Eigen::Index k = 0; k < coefficients_; ++k)  // delta, 1, delta^2, delta^3
            inputs(e, k) = k == 0 ? delta : k == 1 ? 1.0 : std::pow(delta, static_cast<double>(k));
      }
      inputs_.push_back(std::move(inputs));
      first_coefficient_.push_back(own ? plateau : 0);
      plateau += edges;
    }
  }

  Eigen::Index shape_at() const { return coefficients_; }
  Eigen::Index shape_size() const { return directions_ == SpinDirections::apart ? 4 : 3; }
  Eigen::Index start_at(std::size_t record) const {
    return shape_at() + shape_size() + 2 * static_cast<Eigen::Index>(record);
  }
  Eigen::Index unknowns() const { return start_at(records_.size()); }
  Eigen::Index samples() const { return static_cast<Eigen::Index>(count_rows(records_)); }

  MotorShape shape(const Eigen::VectorXd& x) const {
    const Eigen::Index s = shape_at();
    return {x(s), x(s + 1), x(s + 2), directions_ == SpinDirections::apart ? x(s + 3) : 1.0};
  }

  /// Model minus measurement, or the model alone; the Jacobian when it is not null.
  void predict(const Eigen::VectorXd& x, Eigen::VectorXd& Omega, Eigen::MatrixXd* J) const {
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < records_.size(); ++k) {
      const auto n = static_cast<Eigen::Index>(records_[k].rows());
      const Eigen::Index inputs = inputs_[k].cols();
      Eigen::VectorXd c(inputs + 2);
      c << x.segment(first_coefficient_[k], inputs), x.segment(start_at(k), 2);
      const MotorResponses r =
          motor_responses(records_[k], inputs_[k], shape(x), J ? Slopes::yes : Slopes::no);
      Omega.segment(row, n) = r.value * c;  // (1)
      if (J) {
        J->block(row, first_coefficient_[k], n, inputs) = r.value.leftCols(inputs);
        J->block(row, start_at(k), n, 2) = r.value.rightCols(2);
        for (Eigen::Index s = 0; s < shape_size(); ++s)
          J->block(row, shape_at() + s, n, 1) = r.slope[static_cast<std::size_t>(s)] * c;
      }
      row += n;
    }
  }

  /// Start with that shape: everything else is linear.
  struct Start {
    Eigen::VectorXd x;
    double cost;
  };
  Start start(const MotorShape& shape) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns());
    const Eigen::Index s = shape_at();
    x(s) = shape.omega_m;
    x(s + 1) = shape.zeta_m;
    x(s + 2) = shape.dead_time;
    if (directions_ == SpinDirections::apart) x(s + 3) = shape.down_ratio;
    Eigen::MatrixXd linear = Eigen::MatrixXd::Zero(samples(), unknowns());
    Eigen::VectorXd measured(samples());
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < records_.size(); ++k) {
      const auto n = static_cast<Eigen::Index>(records_[k].rows());
      const MotorResponses r = motor_responses(records_[k], inputs_[k], shape, Slopes::no);
      linear.block(row, first_coefficient_[k], n, inputs_[k].cols()) = r.value.leftCols(inputs_[k].cols());
      linear.block(row, start_at(k), n, 2) = r.value.rightCols(2);
      measured.segment(row, n) = Eigen::Map<const Eigen::VectorXd>(records_[k].Omega.data(), n);
      row += n;
    }
    const Eigen::VectorXd c = linear.colPivHouseholderQr().solve(measured);
    for (Eigen::Index i = 0; i < unknowns(); ++i)
      if (i < s || i >= s + shape_size()) x(i) = c(i);
    return {x, (linear * c - measured).squaredNorm()};
  }

  LeastSquaresProblem problem(const std::vector<Eigen::VectorXd>& starts) const {
    LeastSquaresProblem p{.residuals = samples() + 1};
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
    p.series.push_back({.begin = row, .end = row + 1, .group = 1});
    p.evaluate = [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
      Eigen::VectorXd Omega(samples());
      predict(x, Omega, J);
      Eigen::Index at = 0;
      for (const StepRecord& record : records_)
        for (const double measured : record.Omega) r(at) = Omega(at) - measured, ++at;
      // A motor without inertia is as likely to the data as one of first order: the prior ends the search.
      r(at) = std::log(x(shape_at()) / kUsualOmega) / kOmegaSpread;
      if (J) (*J)(at, shape_at()) = 1.0 / (kOmegaSpread * x(shape_at()));
      return true;
    };
    return p;
  }

  MotorFit solve(const std::vector<Eigen::VectorXd>& starts) const {
    MotorFit result{.curve = curve_, .fit = solve_least_squares(problem(starts), {.search_widely = false})};
    result.shape = shape(result.fit.x);
    Eigen::VectorXd Omega(samples());
    predict(result.fit.x, Omega, nullptr);
    result.predicted.assign(Omega.begin(), Omega.end());
    return result;
  }

 private:
  std::string name(Eigen::Index i) const {
    static const std::vector<std::string> polynomial = {"km", "Omega_0", "k2", "k3"};
    static const std::vector<std::string> shape = {"omega_m", "zeta_m", "dead_time", "down_ratio"};
    if (i < shape_at())
      return curve_ == StaticCurve::plateaus ? fmt::format("level_{}", i)
                                             : polynomial[static_cast<std::size_t>(i)];
    if (i < shape_at() + shape_size()) return shape[static_cast<std::size_t>(i - shape_at())];
    return fmt::format("start_{}", i - shape_at() - shape_size());
  }

  const std::vector<StepRecord>& records_;
  StaticCurve curve_;
  SpinDirections directions_;
  Eigen::Index coefficients_ = 0;
  std::vector<Eigen::MatrixXd> inputs_;
  std::vector<Eigen::Index> first_coefficient_;
};

/// The most promising shapes of a coarse grid, best first.
std::vector<MotorShape> promising_shapes(const std::vector<StepRecord>& records) {
  const MotorProblem line(records, count_levels(records) > 1 ? StaticCurve::line : StaticCurve::proportional,
                          SpinDirections::alike);
  std::vector<std::pair<double, MotorShape>> tried;
  for (const double omega_m : {6.0, 15.0, 35.0, 90.0, 300.0, 1200.0})
    for (const double zeta_m : {0.5, 1.0, 1.8})
      for (const double dead_time : {0.0, 0.015, 0.04}) {
        const MotorShape shape{omega_m, zeta_m, dead_time};
        tried.emplace_back(line.start(shape).cost, shape);
      }
  std::ranges::sort(tried, {}, [](const auto& t) { return t.first; });
  return {tried[0].second, tried[1].second, tried[2].second};
}

bool has_plateaus(const std::vector<StepRecord>& records) {
  const std::size_t edges = count_edges(records);
  return count_levels(records) >= 3 && edges <= kMostPlateaus &&
         count_rows(records) >= edges * kFewestRowsOfAPlateau;
}

}  // namespace

MotorFit fit_motor(const std::vector<StepRecord>& records) {
  std::vector<MotorShape> shapes = promising_shapes(records);
  const auto fitted = [&](StaticCurve curve) {
    const MotorProblem problem(records, curve, SpinDirections::alike);
    std::vector<Eigen::VectorXd> starts;
    for (const MotorShape& shape : shapes) starts.push_back(problem.start(shape).x);
    return problem.solve(starts);
  };
  MotorFit best = fitted(StaticCurve::proportional);
  std::vector<StaticCurve> others = {StaticCurve::line};
  if (has_plateaus(records))
    others.push_back(StaticCurve::plateaus);
  else if (count_levels(records) >= 5)
    others.push_back(StaticCurve::cubic);
  for (const StaticCurve curve : others) {
    shapes = {best.shape};
    const MotorFit other = fitted(curve);
    if (other.fit.bic < best.fit.bic - kEvident) best = other;
  }
  return best;
}

MotorFit fit_motor_directions(const std::vector<StepRecord>& records, const MotorFit& alike) {
  const MotorProblem problem(records, alike.curve, SpinDirections::apart);
  return problem.solve({problem.start(alike.shape).x});
}

}  // namespace ident
