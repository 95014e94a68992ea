// Equations (1) to (3) of thrust_sweep_fit.h as a least-squares problem.
#pragma once

#include <string>
#include <vector>

#include "ident/estimators/thrust_sweep_fit.h"

namespace ident {

/// Unknowns, residuals and their places for the points of one file.
class SweepModel {
 public:
  SweepModel(const SweepPoints& points, ThrustLaw law);

  const LeastSquaresProblem& problem() const { return problem_; }
  bool speed_modelled() const { return !set_points_.empty(); }
  /// Residuals [begin, end) of the moving points of a channel, 0 thrust, 1 torque.
  ResidualSeries moving(std::size_t channel) const { return channels_[channel].moving; }
  ResidualSeries speeds() const { return speeds_; }

 private:
  struct Row {  // one moving point
    double w, value;
    int set_point;  // index into set_points_; -1: the measured speed counts
  };
  struct Channel {
    int constant, tare, offset, slope;  // places of unknowns; -1: none
    std::vector<Row> rows;
    std::vector<double> rest;
    ResidualSeries moving, at_rest;
  };
  struct SpeedReading {
    double w;
    int set_point;
  };

  void add_set_points(const SweepPoints& points);
  void add_channel(const SweepChannel& from, const char* constant, bool law_with_linear_term);
  void add_groups(const SweepPoints& points);
  int add_unknown(std::string name, double start, Coordinate coordinate);
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const;
  void evaluate_row(const Channel& channel, const Row& row, Eigen::Index at, const Eigen::VectorXd& x,
                    Eigen::VectorXd& r, Eigen::MatrixXd* J) const;

  LeastSquaresProblem problem_;
  std::vector<Channel> channels_;
  std::vector<SpeedReading> readings_;
  std::vector<int> set_points_;  // of the file, in the order of their unknowns
  ResidualSeries speeds_;
  int share_ = -1, first_speed_ = -1;
};

/// Whether readings at repeated set-points scatter enough to matter against the forces' own scatter.
bool speed_scatter_matters(const SweepPoints& points);

}  // namespace ident
