// The states of a chain: taken over, moved by a step, their defects at the links, and the states where arcs
// end.
#include <algorithm>
#include <cmath>

#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSlow = 100.0;  // rad/s: least speed that counts as the speed of the fastest rotor
constexpr double kWild = 5.0;    // times that speed: longer steps of a rotor speed are shortened

}  // namespace

void FlightSmoother::start_from(const FlightSmoother& other) {
  const std::vector<double> p = other.theta_->p(other.u_);
  const std::vector<std::vector<Seed>> none(static_cast<std::size_t>(record_->logs));
  std::array<double, kChannels> weight;
  for (std::size_t c = 0; c < kChannels; ++c) weight[c] = 1.0 / other.noise_.sigma[c];
  std::vector<std::size_t> from(places_.size());  // the chunk of the other one in which each begins
  for (std::size_t k = 0, at = 0; k < places_.size(); ++k) {
    while (other.places_[at].arc != places_[k].arc || other.places_[at].end <= places_[k].begin) ++at;
    from[k] = at;
  }
  in_parallel(places_.size(), [&](std::size_t k) {
    states_[k] = other.states_[from[k]];
    if (other.places_[from[k]].begin == places_[k].begin) return;
    ChunkTask one = other.task(from[k], other.u_, p, none);
    one.x0 = states_[k], one.end = places_[k].begin, one.steps = other.by_;
    one.weight = weight.data(), one.jacobian = false;
    ChunkResult result;
    evaluate_chunk(one, result);
    const bool flew = result.x_end.body.w_B.allFinite() && result.x_end.body.v_W.allFinite();
    states_[k] =
        flew ? result.x_end : record_->arcs[static_cast<std::size_t>(places_[k].arc)].start(places_[k].begin);
  });
  set_axes();
}

// Turns the accelerations of all states to the axes of the noise model.
void FlightSmoother::set_axes() {
  for (FlightState<double>& x : states_) {
    if (x.outside.axes == noise_.axes) continue;
    const Eigen::Matrix3d R_WB = rotation(x.body.q_WB);
    const bool turns = noise_.axes == GustAxes::body;
    x.outside.v_dot = (turns ? Eigen::Matrix3d(R_WB.transpose()) : R_WB) * x.outside.v_dot;
    x.outside.axes = noise_.axes;
  }
  trial_ = states_;
  set_input_errors();
}

FlightState<double> FlightSmoother::moved(const FlightState<double>& x, const VectorXd& dx) const {
  const StateLayout& layout = record_->layout;
  FlightState<double> y = x;
  y.body.w_B += dx.segment<3>(layout.w);
  if (layout.attitude >= 0) {
    Eigen::Vector3d turn = dx.segment<3>(layout.attitude);
    const double angle = turn.norm();
    if (angle > 0.5) turn *= 0.5 / angle;  // a wild step of a first iteration
    y.body.q_WB = quaternion_product(x.body.q_WB, quaternion_from_rotation_vector(turn)).normalized();
  }
  if (layout.v >= 0) y.body.v_W += dx.segment<3>(layout.v);
  if (layout.x >= 0) y.body.x_W += dx.segment<3>(layout.x);
  if (layout.w_dot >= 0) y.outside.w_dot_B += dx.segment<3>(layout.w_dot);
  if (layout.v_dot >= 0) y.outside.v_dot += dx.segment<3>(layout.v_dot);
  for (std::size_t g = 0; g < kShownGroups; ++g)
    if (layout.shown_error[g] >= 0) y.shown_error[g] += dx.segment<3>(layout.shown_error[g]);
  if (layout.motors < 0) return y;
  double fastest = kSlow, wild = 0;
  for (int n = 0; n < layout.rotors; ++n) {
    fastest = std::max(fastest, std::abs(x.motors[static_cast<std::size_t>(n)].Omega));
    wild = std::max(wild, std::abs(dx[layout.motors + n]));
  }
  // Also a wild step of a first iteration: thrust is not linear over more than that.
  const double most = kWild * fastest, share = wild > most ? most / wild : 1.0;
  for (int n = 0; n < layout.rotors; ++n) {
    y.motors[static_cast<std::size_t>(n)].Omega += share * dx[layout.motors + n];
    y.motors[static_cast<std::size_t>(n)].Omega_dot += share * dx[layout.motors + layout.rotors + n];
  }
  return y;
}

// The end of chunk k in local coordinates relative to the start of the next chunk.
VectorXd FlightSmoother::defect(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const FlightState<double>&a = results_[k].x_end, &b = trial_[k + 1];
  VectorXd d(layout.size);
  d.segment<3>(layout.w) = a.body.w_B - b.body.w_B;
  if (layout.attitude >= 0) {
    const Vec4<double> turn = quaternion_product(conjugate(b.body.q_WB), a.body.q_WB);
    d.segment<3>(layout.attitude) = (turn[0] < 0 ? -2.0 : 2.0) * turn.tail<3>();
  }
  if (layout.v >= 0) d.segment<3>(layout.v) = a.body.v_W - b.body.v_W;
  if (layout.x >= 0) d.segment<3>(layout.x) = a.body.x_W - b.body.x_W;
  const VectorXd share = carried(k);
  const auto carries = [&](int at, const Vec3<double>& before, const Vec3<double>& after) {
    if (at >= 0) d.segment<3>(at) = share.segment<3>(at).cwiseProduct(before) - after;
  };
  carries(layout.w_dot, a.outside.w_dot_B, b.outside.w_dot_B);
  carries(layout.v_dot, a.outside.v_dot, b.outside.v_dot);
  for (std::size_t g = 0; g < kShownGroups; ++g)
    carries(layout.shown_error[g], a.shown_error[g], b.shown_error[g]);
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const auto m = static_cast<std::size_t>(n);
    d[layout.motors + n] = a.motors[m].Omega - b.motors[m].Omega;
    d[layout.motors + layout.rotors + n] = a.motors[m].Omega_dot - b.motors[m].Omega_dot;
  }
  return d;
}

std::vector<FlightSmoother::End> FlightSmoother::arc_ends() {
  const int n = record_->layout.size;
  const std::vector<VectorXd> dx = state_steps(accepted(), VectorXd::Zero(theta_->size()));
  std::vector<End> ends;
  for (const Chain& chain : chains_) {
    const std::size_t last = chain.end - 1;
    const MatrixXd P =
        chain.meet == last ? own_covariance(accepted(), last) : covariances_by(accepted_at_).P[last];
    const MatrixXd E = chunk::E(results_[last], n).leftCols(n);
    ends.push_back({moved(results_[last].x_end, E * dx[last]), E * P.leftCols(n) * E.transpose()});
  }
  return ends;
}

}  // namespace ident
