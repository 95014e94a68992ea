// What it changes how flight is simulated.
#include <array>
#include <cmath>

#include "ident/estimators/flight_smoother.h"

namespace ident {

using Eigen::VectorXd;

namespace {

constexpr double kLeastVariance = 1e-10;  // of an acceleration: no noise means none

// Accelerations about or along an axis, one for each chunk of a chain: minus twice the logarithm of their
// likelihood under a process, but for a constant.
class Surprise {
 public:
  double of_next(const ColouredNoise& noise, double acceleration, double h) {
    const double carried = begun_ ? noise.carried(h) : 0.0, fresh = acceleration - carried * last_;
    begun_ = true, last_ = acceleration;
    return fresh * fresh / (noise.sigma * noise.sigma * (1 - carried * carried) + kLeastVariance);
  }

 private:
  double last_ = 0;
  bool begun_ = false;
};

}  // namespace

// Rates and velocities that differ as accelerations from outside would make them, motors as their own noise
// would.
double FlightSmoother::noise_that_makes(const std::vector<VectorXd>& defects) const {
  const StateLayout& layout = record_->layout;
  std::array<Surprise, 6> surprise;
  double sum = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (k == 0 || !places_[k - 1].linked) surprise = {};
    if (!places_[k].linked) continue;
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
    const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
    const AirNoise& air = air_of(k);
    const VectorXd& d = defects[k];
    const auto add = [&](const std::array<ColouredNoise, 3>& noise, const Eigen::Vector3d& moved,
                         std::size_t first) {
      for (std::size_t i = 0; i < 3; ++i)
        sum += surprise[first + i].of_next(noise[i], moved[static_cast<Eigen::Index>(i)] / h, h);
    };
    if (layout.w_dot >= 0) add(air.w_dot, d.segment<3>(layout.w), 0);
    if (layout.v_dot >= 0) {
      Eigen::Vector3d push = d.segment<3>(layout.v);
      if (noise_.axes == GustAxes::body) push = rotation(states_[k].body.q_WB).transpose() * push;
      add(air.v_dot, push, 3);
    }
    if (layout.motors < 0) continue;
    const int motors = 2 * layout.rotors;
    sum += link_weight(k).segment(layout.motors, motors).dot(d.segment(layout.motors, motors).cwiseAbs2());
  }
  return sum;
}

FlightSmoother::WorthOfSteps FlightSmoother::worth_of_fine_steps() {
  const Steps present = by_;
  std::array<std::vector<std::vector<double>>, 2> rows;
  std::array<std::vector<VectorXd>, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    by_ = i == 0 ? Steps::fine : present;
    rows[i] = residuals(), ends[i] = defects();
  }
  WorthOfSteps worth;
  for (std::size_t k = 0; k < rows[0].size(); ++k)
    for (std::size_t i = 0; i < rows[0][k].size(); ++i)
      if (const double d = rows[0][k][i] - rows[1][k][i]; std::isfinite(d)) worth.rows += d * d;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k].linked) ends[0][k] -= ends[1][k];
  worth.links = noise_that_makes(ends[0]);
  return worth;
}

}  // namespace ident
