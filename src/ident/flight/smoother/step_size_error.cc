// Error of the integration steps: how much fine steps would change residuals and links.
#include <array>
#include <cmath>

#include "ident/flight/smoother/smoother.h"

namespace ident {

using Eigen::VectorXd;

// Cost of the process noise that would make the same defects: those of rates and velocities as accelerations
// from outside, those of rotor speeds as noise of the motors.
double FlightSmoother::noise_that_makes(const std::vector<VectorXd>& defects) const {
  const StateLayout& layout = record_->layout;
  VectorXd before;  // accelerations of the chunk before
  double sum = 0;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (!places_[k].linked) continue;
    const bool goes_on = k > 0 && places_[k - 1].linked;
    const FlightArc& arc = record_->arcs[static_cast<std::size_t>(places_[k].arc)];
    const double h = arc.t[places_[k].end] - arc.t[places_[k].begin];
    const VectorXd& d = defects[k];
    VectorXd outside = VectorXd::Zero(layout.size);
    if (layout.w_dot >= 0) outside.segment<3>(layout.w_dot) = d.segment<3>(layout.w) / h;
    if (layout.v_dot >= 0 && layout.v >= 0) {
      Eigen::Vector3d push = d.segment<3>(layout.v) / h;
      if (noise_.axes == GustAxes::body) push = rotation(states_[k].body.q_WB).transpose() * push;
      outside.segment<3>(layout.v_dot) = push;
    }
    const VectorXd fresh = goes_on ? VectorXd(outside - carried(k - 1).cwiseProduct(before)) : outside;
    const VectorXd weight = goes_on ? link_weight(k - 1) : start_information(k);
    sum += fresh.dot(weight.cwiseProduct(fresh));
    before = outside;
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
