// Exact propagation from event to event: samples of the speed and edges of the delayed command.
#include "ident/bench/motor/motor_step_model.h"

#include <ceres/jet.h>

#include <cmath>
#include <limits>

#include "ident/model/motor.h"

namespace ident {
namespace {

using Jet = ceres::Jet<double, 2>;

/// exp(A h) with its derivatives with respect to omega_m, zeta_m and h.
struct Transition {
  double h = -1.0, omega_m = 0.0;
  Eigen::Matrix2d P, P_omega, P_zeta, P_h;
};

Transition transition(double omega_m, double zeta_m, double h) {
  const MotorTransition<Jet> p = motor_transition(Jet(omega_m, 0), Jet(zeta_m, 1), h);
  Transition result{.h = h, .omega_m = omega_m};
  result.P << p.p11.a, p.p12.a, p.p21.a, p.p22.a;
  result.P_omega << p.p11.v[0], p.p12.v[0], p.p21.v[0], p.p22.v[0];
  result.P_zeta << p.p11.v[1], p.p12.v[1], p.p21.v[1], p.p22.v[1];
  Eigen::Matrix2d A;
  A << 0.0, 1.0, -omega_m * omega_m, -2.0 * zeta_m * omega_m;
  result.P_h = A * result.P;
  return result;
}

/// The state of all signals and its derivatives, carried through time.
class Propagator {
 public:
  Propagator(const MotorShape& shape, const Eigen::RowVectorXd& target, Slopes slopes)
      : shape_(shape), slopes_(slopes), target_(target) {
    const Eigen::Index signals = target.size();
    x_ = Eigen::Matrix2Xd::Zero(2, signals);
    x_(0, signals - 2) = x_(1, signals - 1) = 1.0;
    if (slopes == Slopes::yes)
      for (auto& d : d_) d = Eigen::Matrix2Xd::Zero(2, signals);
  }

  void set_target(const Eigen::RowVectorXd& target, bool down) {
    target_ = target;
    down_ = down;
  }

  /// `h_tau` is the derivative of h with respect to the dead time.
  void advance(double h, double h_tau) {
    const double ratio = down_ ? shape_.down_ratio : 1.0, omega = ratio * shape_.omega_m;
    // Equal distances differ by rounding; what that changes is rounding too.
    if (std::fabs(h - step_.h) > 1e-11 || omega != step_.omega_m) step_ = transition(omega, shape_.zeta_m, h);
    deviation_ = x_;
    deviation_.row(0) -= target_;
    x_.noalias() = step_.P.lazyProduct(deviation_);
    x_.row(0) += target_;
    if (slopes_ == Slopes::no) return;
    for (auto& d : d_) {
      product_.noalias() = step_.P.lazyProduct(d);
      d.swap(product_);
    }
    product_.noalias() = step_.P_omega.lazyProduct(deviation_);
    d_[0] += ratio * product_;
    if (down_) d_[3] += shape_.omega_m * product_;
    d_[1].noalias() += step_.P_zeta.lazyProduct(deviation_);
    if (h_tau != 0.0) d_[2].noalias() += (h_tau * step_.P_h).lazyProduct(deviation_);
  }

  void write(Eigen::Index row, MotorResponses& out) const {
    out.value.row(row) = x_.row(0);
    if (slopes_ == Slopes::yes)
      for (std::size_t k = 0; k < d_.size(); ++k) out.slope[k].row(row) = d_[k].row(0);
  }

 private:
  const MotorShape& shape_;
  Slopes slopes_;
  Eigen::RowVectorXd target_;
  bool down_ = false;
  Eigen::Matrix2Xd x_, deviation_, product_;
  std::array<Eigen::Matrix2Xd, 4> d_;
  Transition step_;
};

}  // namespace

MotorResponses motor_responses(const StepRecord& record, const Eigen::MatrixXd& inputs,
                               const MotorShape& shape, Slopes slopes) {
  const auto rows = static_cast<Eigen::Index>(record.rows());
  const Eigen::Index signals = inputs.cols() + 2;
  MotorResponses out{.value = Eigen::MatrixXd(rows, signals)};
  if (slopes == Slopes::yes)
    for (auto& d : out.slope) d.resize(rows, signals);
  const auto target = [&](std::size_t edge) {
    Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(signals);
    values.head(inputs.cols()) = inputs.row(static_cast<Eigen::Index>(edge));
    return values;
  };

  Propagator state(shape, target(0), slopes);
  std::size_t edge = 0;
  double now = record.t.front();
  bool at_edge = false;  // is `now` the time of a delayed edge? Then it moves with the dead time.
  const auto next_edge = [&] {
    return edge + 1 < record.edges.size() ? record.edges[edge + 1].t + shape.dead_time
                                          : std::numeric_limits<double>::infinity();
  };
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double sample = record.t[static_cast<std::size_t>(i)];
    while (next_edge() <= sample) {
      const double at = next_edge();
      ++edge;
      if (at >= now) {
        state.advance(at - now, at_edge ? 0.0 : 1.0);
        now = at;
        at_edge = true;
      }
      state.set_target(target(edge), record.edges[edge].down);
    }
    // Also over no time at all: an edge that falls on a sample has its derivative.
    if (sample > now || at_edge) state.advance(sample - now, at_edge ? -1.0 : 0.0);
    now = sample;
    at_edge = false;
    state.write(i, out);
  }
  return out;
}

StepAnswer step_answer(const MotorShape& shape, double t) {
  if (t <= shape.dead_time) return {};
  const Transition step = transition(shape.omega_m, shape.zeta_m, t - shape.dead_time);
  return {.value = 1.0 - step.P(0, 0),
          .rate = -step.P_h(0, 0),
          .slope = {-step.P_omega(0, 0), -step.P_zeta(0, 0), step.P_h(0, 0)}};
}

}  // namespace ident
