// Equations (1) to (3) of thrust_sweep_fit.h as a least-squares problem.
#pragma once

#include <string>
#include <vector>

#include "ident/bench/thrust/thrust_sweep_fit.h"

namespace ident {

/// Whether readings at rest have the noise of those in motion, or one of their own.
enum class RestNoise { alike, own };

/// Unknowns, residuals and their places for the points of one file.
class SweepModel {
 public:
  SweepModel(const SweepPoints& points, ThrustLaw law, RestNoise rest_noise);
  SweepModel(const SweepModel&) = delete;  // the problem's function points here
  SweepModel& operator=(const SweepModel&) = delete;

  const LeastSquaresProblem& problem() const { return problem_; }
  bool speed_modelled() const { return !set_points_.empty(); }
  /// Places of the residuals of a channel, 0 thrust, 1 torque: its moving points in their order, its readings
  /// at rest.
  const std::vector<Eigen::Index>& moving(std::size_t channel) const { return channels_[channel].moving; }
  const std::vector<Eigen::Index>& at_rest(std::size_t channel) const { return channels_[channel].at_rest; }
  /// Noise group of the moving points of a channel.
  std::size_t group(std::size_t channel) const { return channels_[channel].group; }
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
    std::vector<Eigen::Index> moving = {}, at_rest = {};
    std::size_t group = 0;
  };
  struct SpeedReading {
    double w;
    int set_point;
  };

  void add_set_points(const SweepPoints& points);
  void add_channel(const SweepChannel& from, const char* constant, bool law_with_linear_term);
  void add_groups(const SweepPoints& points, RestNoise rest_noise);
  void add_residuals(const SweepChannel& from, Channel& channel, int moving_group, int rest_group);
  int add_group(NoiseGroup group);
  ResidualSeries add_series(Eigen::Index rows, int group);
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
