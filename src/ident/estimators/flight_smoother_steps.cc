// What it changes how flight is simulated.
#include <array>
#include <cmath>

#include "ident/estimators/flight_smoother.h"

namespace ident {

using Eigen::VectorXd;

namespace {

constexpr double kLeastVariance = 1e-10;  // of an acceleration: no noise means none

// Of a process that is what one chunk after the other asks of it, minus twice the logarithm of its likelihood
// but for a constant.
class Price {
 public:
  explicit Price(const ColouredNoise& noise) : noise_(noise) {}
  double of_next(double acceleration, double h) {
    const double variance = noise_.sigma * noise_.sigma + kLeastVariance;
    const double carried = begun_ ? noise_.carried(h) : 0.0, fresh = acceleration - carried * last_;
    begun_ = true, last_ = acceleration;
    return fresh * fresh / (variance * (1 - carried * carried) + kLeastVariance);
  }

 private:
  ColouredNoise noise_;
  double last_ = 0;
  bool begun_ = false;
};

}  // namespace

// Differences of velocities and rates as accelerations from outside would make them, those of motors as their
// own noise would.
double FlightSmoother::noise_that_makes(const std::vector<VectorXd>& defects) const {
  const StateLayout& layout = record_->layout;
  std::vector<std::array<Price, 6>> prices;
  double sum = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
    if (k == 0 || !places_[k - 1].linked) {
      const AirNoise& air = noise_.in_log(arc.log);
      prices.assign(1, {Price(air.w_dot[0]), Price(air.w_dot[1]), Price(air.w_dot[2]), Price(air.v_dot[0]),
                        Price(air.v_dot[1]), Price(air.v_dot[2])});
    }
    if (!places_[k].linked) continue;
    const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
    const VectorXd& d = defects[k];
    const auto add = [&](const Eigen::Vector3d& moved, std::size_t first) {
      for (std::size_t i = 0; i < 3; ++i)
        sum += prices[0][first + i].of_next(moved[static_cast<Eigen::Index>(i)] / h, h);
    };
    if (layout.w_dot >= 0) add(d.segment<3>(layout.w), 0);
    if (layout.v_dot >= 0) {
      const Eigen::Vector3d push = d.segment<3>(layout.v);
      add(noise_.axes == GustAxes::world ? push
                                         : Eigen::Vector3d(rotation(states_[k].body.q_WB).transpose() * push),
          3);
    }
    if (layout.motors < 0) continue;
    const Eigen::Index motors = 2 * record_->layout.rotors;
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
