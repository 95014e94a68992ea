// The state of a chunk with derivatives: seeded at its start, read off at its end.
#pragma once

#include "ident/flight/kernel/kernel_columns.h"

namespace ident {

/// Seeds and reads the derivatives of the columns [from, from + S::width).
template <class Isa>
class KernelState {
 public:
  KernelState(const ChunkTask& task, const KernelPlace<Isa>* place, const KernelColumn<Isa>* column)
      : task_(task), place_(place), column_(column), d_(task.layout.size + task.thetas) {}

  /// The state at the start, each component with its own direction.
  template <class S>
  FlightState<S> seeded(int from, int to) const {
    const FlightState<double>& x = task_.x0;
    const StateLayout& layout = task_.layout;
    FlightState<S> s;
    const auto seed = [&](S& scalar, int external, double derivative) {
      const int at = place_[external].at;
      if (at >= from && at < to) scalar.seed(at - from, derivative);
    };
    s.outside.axes = x.outside.axes;
    for (int k = 0; k < 4; ++k) s.body.q_WB[k] = S(x.body.q_WB[k]);
    for (int k = 0; k < 3; ++k) {
      s.body.w_B[k] = S(x.body.w_B[k]), s.body.v_W[k] = S(x.body.v_W[k]), s.body.x_W[k] = S(x.body.x_W[k]);
      seed(s.body.w_B[k], layout.w + k, 1.0);
      if (layout.v >= 0) seed(s.body.v_W[k], layout.v + k, 1.0);
      if (layout.x >= 0) seed(s.body.x_W[k], layout.x + k, 1.0);
      s.outside.w_dot_B[k] = S(x.outside.w_dot_B[k]), s.outside.v_dot[k] = S(x.outside.v_dot[k]);
      if (layout.w_dot >= 0) seed(s.outside.w_dot_B[k], layout.w_dot + k, 1.0);
      if (layout.v_dot >= 0) seed(s.outside.v_dot[k], layout.v_dot + k, 1.0);
      if (layout.attitude < 0) continue;
      // Half of q * (0, e_k), written out: no function of plain numbers may be compiled here.
      const double w = 0.5 * x.body.q_WB[0], along = 0.5 * x.body.q_WB[1 + k],
                   before = 0.5 * x.body.q_WB[1 + (k + 2) % 3], after = 0.5 * x.body.q_WB[1 + (k + 1) % 3];
      seed(s.body.q_WB[0], layout.attitude + k, -along);
      seed(s.body.q_WB[1 + k], layout.attitude + k, w);
      seed(s.body.q_WB[1 + (k + 1) % 3], layout.attitude + k, before);
      seed(s.body.q_WB[1 + (k + 2) % 3], layout.attitude + k, -after);
    }
    for (int i = 0; i < layout.rotors; ++i) {
      const auto m = static_cast<std::size_t>(i);
      s.motors[m] = {S(x.motors[m].Omega), S(x.motors[m].Omega_dot)};
      if (layout.motors < 0) continue;
      seed(s.motors[m].Omega, layout.motors + i, 1.0);
      seed(s.motors[m].Omega_dot, layout.motors + layout.rotors + i, 1.0);
    }
    return s;
  }

  /// Stores rows of E, the derivative of the end state.
  template <class S>
  void store_end(const FlightState<S>& end, int from, double* E) const {
    const StateLayout& layout = task_.layout;
    const auto& q = end.body.q_WB;
    const Vec4<double> inverse(q[0].v, -q[1].v, -q[2].v, -q[3].v);
    const Vec4<S> turn = quaternion_product(inverse, q);
    for (int k = 0; k < 3; ++k) {
      put_end(E, layout.w + k, end.body.w_B[k], from);
      if (layout.attitude >= 0) put_end(E, layout.attitude + k, S(2.0 * turn[1 + k]), from);
      if (layout.v >= 0) put_end(E, layout.v + k, end.body.v_W[k], from);
      if (layout.x >= 0) put_end(E, layout.x + k, end.body.x_W[k], from);
      if (layout.w_dot >= 0) put_end(E, layout.w_dot + k, end.outside.w_dot_B[k], from);
      if (layout.v_dot >= 0) put_end(E, layout.v_dot + k, end.outside.v_dot[k], from);
    }
    if (layout.motors < 0) return;
    for (int i = 0; i < layout.rotors; ++i) {
      put_end(E, layout.motors + i, end.motors[static_cast<std::size_t>(i)].Omega, from);
      put_end(E, layout.motors + layout.rotors + i, end.motors[static_cast<std::size_t>(i)].Omega_dot, from);
    }
  }

  /// The values without derivatives.
  template <class S>
  FlightState<double> values(const FlightState<S>& s) const {
    FlightState<double> x = task_.x0;
    for (int k = 0; k < 4; ++k) x.body.q_WB[k] = s.body.q_WB[k].v;
    for (int k = 0; k < 3; ++k) {
      x.body.w_B[k] = s.body.w_B[k].v, x.body.v_W[k] = s.body.v_W[k].v, x.body.x_W[k] = s.body.x_W[k].v;
      x.outside.w_dot_B[k] = s.outside.w_dot_B[k].v, x.outside.v_dot[k] = s.outside.v_dot[k].v;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(task_.layout.rotors); ++i)
      x.motors[i] = {s.motors[i].Omega.v, s.motors[i].Omega_dot.v};
    return x;
  }

 private:
  template <class S>
  void put_end(double* E, int row, const S& scalar, int from) const {
    E += static_cast<std::size_t>(row) * static_cast<std::size_t>(d_);
    for (int i = 0; i < S::width; ++i)
      if (column_[from + i].external >= 0) E[column_[from + i].external] = scalar.derivative(i);
  }

  const ChunkTask& task_;
  const KernelPlace<Isa>* place_;
  const KernelColumn<Isa>* column_;
  int d_;
};

}  // namespace ident
