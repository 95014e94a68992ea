// A flight as windows of measured motion, and models of it linearised there over every cause at once.
//
// Forces, or moments, are looked at with attitude, rates and velocity as measured, so nothing runs away.
// Where a vehicle's trim stands (lasting moments, a lateral share of the thrust, the push of a steady wind)
// is free in each log: every vehicle has some, and too many causes make it.
#pragma once

#include <array>
#include <vector>

#include "ident/flight/ladder/window_residuals.h"
#include "ident/gap/hypotheses/next_model.h"
#include "ident/gap/statistics/residual_wrench.h"

namespace ident {

/// Information on a unit of a constant below which windows tell nothing of it.
inline constexpr double kHidden = 1e-3;

/// What forces, or moments, of a model miss, and the slopes over the constants and the trim of each log.
struct WindowMisses {
  Eigen::VectorXd missed;  ///< three components a window
  Eigen::MatrixXd slopes;  ///< [component][unknown]
  Eigen::VectorXd weight;  ///< inverse variances, less where residuals hang together
};

/// Where a search over windows stands.
struct WindowStanding {
  Standing at;
  Eigen::VectorXd trim;  ///< unknowns after the constants
  WindowMisses misses;
};

class WindowModel {
 public:
  /// Of forces or of moments; the record must outlive it. Causes of `settled` are told elsewhere.
  WindowModel(const FlightRecord& record, FitTo what, std::vector<std::string> settled = {});

  /// Whether they were logged, over enough of flight.
  bool tells() const { return !windows_.empty(); }
  FitTo what() const { return what_; }
  const FlightRecord& record() const { return record_; }
  const MeasuredMotion& motion() const { return motion_; }
  const std::vector<Window>& windows() const { return windows_; }

  /// The model with those constants and causes, fitted and linearised over every cause that windows can show,
  /// but those of `exclude`.
  WindowStanding standing(const Vehicle& vehicle, const std::vector<std::string>& exclude,
                          std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                          const std::vector<double>& p) const;

 private:
  struct Fitted;
  Fitted fitted(std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                const std::vector<double>& p) const;
  WindowMisses linearised(const Theta& theta, const Eigen::VectorXd& u, const Eigen::VectorXd& trim) const;
  void weigh(WindowMisses& misses, const Theta& theta, const Eigen::VectorXd& u) const;
  std::vector<ScoreBlock> blocks_of(const WindowMisses& misses) const;
  Eigen::Index trim_size() const;

  const FlightRecord& record_;
  FitTo what_;
  std::vector<std::string> settled_;
  MeasuredMotion motion_;
  std::vector<Window> windows_;
};

/// Variance of a component of what is missed over windows by the noise of the sensors alone, as the logged
/// signal shows it from row to row.
double sensor_variance(const MeasuredMotion& motion, FitTo what);

/// What a model misses as force, or moment, on the body.
ResidualWrench wrench_of(const WindowModel& model, const WindowStanding& standing);

}  // namespace ident
