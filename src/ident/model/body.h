// Forces, moments and accelerations of a multirotor at a state, for any number of rotors: the equation that
// serves every airframe.
//
//   F = sum_n T_n a_n ,   T_n = kT Omega_n^2 ,   Q_n = kQ Omega_n^2                                   (3)
//   M = sum_n (r_n x T_n a_n - s_n Q_n a_n) - sigma sum_n s_n Jp (Omega_n' a_n + Omega_n w x a_n)     (4)
//   J w' = M - c x F - w x J w                        about the centre of gravity c                   (5)
//   f = F/m - w' x c - w x (w x c) ,   v' = R f + g   specific force and motion of the origin         (6)
//   q' = q * (0, w)/2 ,   x' = v                                                                      (7)
//
// sigma = +1: the rotor's momentum is +s Jp Omega a, its rate of change acts on the body with a minus; -1 is
// printed in [Phang 16, 18, 19] (erratum 1). Drag of [Selby]: -diag(Kdx, Kdy, Kdz) v_W, along the world axes.
// `c` is zero unless an effect moves the centre of gravity off the origin.
#pragma once

#include <span>
#include <vector>

#include "ident/model/motor.h"
#include "ident/model/parameters.h"
#include "ident/model/seams.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Attitude, body rates, velocity and position of the origin.
template <class S>
struct BodyState {
  Vec4<S> q_WB;
  Vec3<S> w_B, v_W, x_W;
};

/// Axes along which an acceleration from outside keeps its direction: wind that of the world, what the air
/// does to rotors and body turns with them.
enum class GustAxes { world, body };

/// Accelerations that nothing in the model explains, gusts mostly: constant over a piece of flight. They add
/// to (5) and (6), so that an accelerometer feels them. What turns the vehicle is a moment: `w_dot_B` is what
/// it makes of the moments of inertia alone, and products of inertia couple it to the other axes.
template <class S>
struct Disturbance {
  Vec3<S> w_dot_B{S(0.0), S(0.0), S(0.0)}, v_dot{S(0.0), S(0.0), S(0.0)};
  GustAxes axes = GustAxes::world;  ///< of v_dot
};

/// Time derivative of a BodyState, and the specific force at the origin.
template <class S>
struct BodyRate {
  Vec4<S> q_dot;
  Vec3<S> w_dot_B, v_dot_W, x_dot_W;
  Vec3<S> f_B;
};

template <class S>
struct Wrench {
  Vec3<S> F_B, M_B;  ///< N, and N m about the origin; without gravity
};

/// What the rotors give: force, moment of thrust, drag and reaction, and sigma times their angular momentum.
template <class S>
struct RotorSums {
  Vec3<S> F_B, M_B, h_B;
};

/// The body with one set of constants. `p` is the parameter vector (model/parameters.h); both it and the
/// vehicle must outlive the object. Nothing here depends on the state: build once per set of constants.
template <class S, class Effects = NoEffects>
class Body {
 public:
  Body(const Vehicle& vehicle, std::span<const S> p, const Effects& effects)
      : vehicle_(&vehicle), p_(p), effects_(&effects) {
    using std::cos, std::sin;
    MassSeam<S> mass{p[param::m], inertia_matrix(p), Vec3<S>(S(0.0), S(0.0), S(0.0)), p[param::Jp]};
    effects.apply(mass);
    m_ = mass.m, J_ = mass.J, c_B_ = mass.c_B, Jp_ = mass.Jp;
    J_inverse_ = inverse(J_);
    off_centre_ = !is_identically_zero(c_B_[0]) || !is_identically_zero(c_B_[1]) ||
                  !is_identically_zero(c_B_[2]) || (effects.touches() & kTouchCentre) != 0;
    spinning_ = !is_identically_zero(Jp_) || (effects.touches() & kTouchSpin) != 0;
    linear_drag_ = !is_identically_zero(p[param::Kdx]) || !is_identically_zero(p[param::Kdy]) ||
                   !is_identically_zero(p[param::Kdz]);
    const S c = cos(p[param::alpha]), s = sin(p[param::alpha]);
    for (const Rotor& rotor : vehicle.rotors) {
      if (rotor.slant_B.isZero()) {
        a_B_.push_back(Vec3<S>(S(rotor.a_B[0]), S(rotor.a_B[1]), S(rotor.a_B[2])));
      } else {
        a_B_.push_back(Vec3<S>(s * rotor.slant_B[0], s * rotor.slant_B[1], -c));
      }
    }
    const double kT = value(p[param::kT]), n = static_cast<double>(vehicle.rotors.size());
    if (kT > 0) per_Omega_hover_ = sqrt((n / vehicle.g) * p[param::kT] / p[param::m]);
    m_inverse_ = 1.0 / m_;
    diagonal_ =
        is_identically_zero(J_(0, 1)) && is_identically_zero(J_(0, 2)) && is_identically_zero(J_(1, 2));
    plain_ = !linear_drag_ && (effects.touches() & (kTouchFlow | kTouchHeight)) == 0;
    for (std::size_t k = 0; k < a_B_.size(); ++k) {
      const Rotor& rotor = vehicle.rotors[k];
      for (int i = 0; i < 3; ++i) fixed_axes_ = fixed_axes_ && is_constant(a_B_[k][i]);
      const Eigen::Vector3d a(value(a_B_[k][0]), value(a_B_[k][1]), value(a_B_[k][2]));
      const Eigen::Vector3d& r = rotor.r_B;
      arms_.push_back({a,
                       {r[1] * a[2] - r[2] * a[1], r[2] * a[0] - r[0] * a[2], r[0] * a[1] - r[1] * a[0]},
                       rotor.s * a});
    }
    air_.wind_W = Vec3<S>(S(0.0), S(0.0), S(0.0));
    effects.apply(air_);
  }

  /// Equations (3) and (4) with the rotor and body seams; `R_WB` belongs to `state.q_WB`.
  Wrench<S> wrench(const BodyState<S>& state, const Mat3<S>& R_WB,
                   std::span<const MotorState<S>> motors) const {
    if (plain_) return under(state, rotor_sums(motors));
    const S zero(0.0);
    Around around{Vec3<S>(zero, zero, zero), &state, &R_WB};
    const bool flow = (effects_->touches() & kTouchFlow) != 0;
    if (flow) around.v_air_B = turned_into_body(R_WB, Vec3<S>(state.v_W - air_.wind_W));
    Wrench<S> total = under(state, sums(motors, &around));
    if (flow) {
      BodySeam<S> body{around.v_air_B, Vec3<S>(zero, zero, zero), Vec3<S>(zero, zero, zero)};
      effects_->apply(body);
      total.F_B += body.F_B;
      total.M_B += body.M_B + cross(c_B_, body.F_B);
    }
    if (linear_drag_) {
      const Vec3<S> drag_W(-p_[param::Kdx] * state.v_W[0], -p_[param::Kdy] * state.v_W[1],
                           -p_[param::Kdz] * state.v_W[2]);
      const Vec3<S> drag_B = turned_into_body(R_WB, drag_W);
      total.F_B += drag_B;
      total.M_B += cross(c_B_, drag_B);
    }
    return total;
  }

  /// Whether what the rotors give does not depend on how the body moves, and nothing else acts on it.
  bool plain() const { return plain_; }
  /// Whether rotors have a momentum of their own.
  bool spinning() const { return spinning_; }

  /// Equations (3) and (4) for a plain body but for the turning of the rotors' momentum.
  RotorSums<S> rotor_sums(std::span<const MotorState<S>> motors) const { return sums(motors, nullptr); }

  /// Equations (5) to (7), with accelerations from outside if there are any.
  BodyRate<S> rate(const BodyState<S>& state, std::span<const MotorState<S>> motors,
                   const Disturbance<S>* outside = nullptr) const {
    const Mat3<S> R_WB = rotation(state.q_WB);
    return rate_under(wrench(state, R_WB, motors), state, R_WB, outside);
  }
  /// The same for a plain body.
  BodyRate<S> rate(const BodyState<S>& state, const RotorSums<S>& rotors,
                   const Disturbance<S>* outside = nullptr) const {
    return rate_under(under(state, rotors), state, rotation(state.q_WB), outside);
  }

  const S& mass() const { return m_; }
  const Mat3<S>& J() const { return J_; }
  const Vec3<S>& centre_of_gravity() const { return c_B_; }
  const S& per_Omega_hover() const { return per_Omega_hover_; }

 private:
  // What a hub sees of the body's motion.
  struct Around {
    Vec3<S> v_air_B;
    const BodyState<S>* state;
    const Mat3<S>* R_WB;
  };

  // Sums over the rotors of T, Q, s Omega and s Omega' with vectors that are constants wherever the axes are.
  // `around` may be null for a plain body.
  RotorSums<S> sums(std::span<const MotorState<S>> motors, const Around* around) const {
    const S zero(0.0);
    const unsigned touches = effects_->touches();
    const bool seam = (touches & kTouchRotor) != 0, fixed = fixed_axes_ && (touches & kTouchAxis) == 0;
    Vec3<S> F(zero, zero, zero), M(zero, zero, zero), Q(zero, zero, zero), h(zero, zero, zero),
        h_dot(zero, zero, zero);
    const auto add = [](Vec3<S>& sum_B, const Eigen::Vector3d& direction, const S& x) {
      for (int i = 0; i < 3; ++i)
        if (direction[i] != 0) sum_B[i] = sum(sum_B[i], direction[i], x);
    };
    const auto with_fixed_axis = [&](std::size_t n, const S& T, const S& drag) {
      const Arm& arm = arms_[n];
      add(F, arm.a_B, T), add(M, arm.moment_B, T), add(Q, arm.spin_B, drag);
      if (spinning_) add(h, arm.spin_B, motors[n].Omega), add(h_dot, arm.spin_B, motors[n].Omega_dot);
    };
    const auto with_free_axis = [&](std::size_t n, const Vec3<S>& a_B, const S& T, const S& drag) {
      const Rotor& geometry = vehicle_->rotors[n];
      const double s = geometry.s;
      const Vec3<S> thrust = T * a_B;
      F += thrust, M += cross(geometry.r_B, thrust), Q += (s * drag) * a_B;
      if (spinning_) h += (s * motors[n].Omega) * a_B, h_dot += (s * motors[n].Omega_dot) * a_B;
    };
    for (std::size_t n = 0; n < arms_.size(); ++n) {
      const S& Omega = motors[n].Omega;
      const S Omega2 = Omega * Omega;
      if (!seam) {  // over kT and kQ, which multiply the sums
        fixed ? with_fixed_axis(n, Omega2, Omega2) : with_free_axis(n, a_B_[n], Omega2, Omega2);
        continue;
      }
      const Eigen::Vector3d& r_B = vehicle_->rotors[n].r_B;
      RotorSeam<S> rotor;
      rotor.index = static_cast<int>(n), rotor.per_Omega_hover = &per_Omega_hover_;
      rotor.axis = fixed ? &arms_[n].a_B : nullptr, rotor.a_B = a_B_[n];
      rotor.Omega = Omega, rotor.T = p_[param::kT] * Omega2, rotor.Q = p_[param::kQ] * Omega2;
      if (around && (touches & kTouchFlow)) rotor.v_air_B = around->v_air_B + cross(around->state->w_B, r_B);
      if (around && (touches & kTouchHeight))
        rotor.height = vehicle_->ground_z - (around->state->x_W[2] + dot(Vec3<S>(around->R_WB->row(2)), r_B));
      if (touches & kTouchHub) rotor.F_B = rotor.M_B = Vec3<S>(zero, zero, zero);
      effects_->apply(rotor);
      if (touches & kTouchHub) F += rotor.F_B, M += rotor.M_B + cross(r_B, rotor.F_B);
      fixed ? with_fixed_axis(n, rotor.T, rotor.Q) : with_free_axis(n, rotor.a_B, rotor.T, rotor.Q);
    }
    RotorSums<S> total;
    for (int i = 0; i < 3; ++i) {
      total.F_B[i] = seam ? F[i] : p_[param::kT] * F[i];                                // (3)
      total.M_B[i] = seam ? M[i] - Q[i] : p_[param::kT] * M[i] - p_[param::kQ] * Q[i];  // (4)
    }
    if (spinning_) {
      const S momentum = (vehicle_->signs == Signs::first_principles ? 1.0 : -1.0) * Jp_;  // erratum 1
      for (int i = 0; i < 3; ++i) total.M_B[i] -= momentum * h_dot[i], total.h_B[i] = momentum * h[i];  // (4)
    }
    return total;
  }

  Wrench<S> under(const BodyState<S>& state, const RotorSums<S>& rotors) const {
    Wrench<S> total{rotors.F_B, rotors.M_B};
    if (spinning_) total.M_B -= cross(state.w_B, rotors.h_B);  // (4)
    return total;
  }

  BodyRate<S> rate_under(const Wrench<S>& total, const BodyState<S>& state, const Mat3<S>& R_WB,
                         const Disturbance<S>* outside) const {
    const Vec3<S>& w = state.w_B;
    BodyRate<S> out;
    Vec3<S> M = total.M_B - cross(w, times(J_, w));
    if (off_centre_) M -= cross(c_B_, total.F_B);
    if (outside && !diagonal_)
      for (int i = 0; i < 3; ++i) M[i] = M[i] + J_(i, i) * outside->w_dot_B[i];
    out.w_dot_B = times(J_inverse_, M);  // (5)
    if (outside && diagonal_) out.w_dot_B += outside->w_dot_B;
    for (int i = 0; i < 3; ++i) out.f_B[i] = total.F_B[i] * m_inverse_;  // (6)
    if (off_centre_) out.f_B -= cross(out.w_dot_B, c_B_) + cross(w, cross(w, c_B_));
    if (outside && outside->axes == GustAxes::world)
      out.f_B += turned_into_body(R_WB, outside->v_dot);
    else if (outside)
      out.f_B += outside->v_dot;
    for (int i = 0; i < 3; ++i)
      out.v_dot_W[i] = R_WB(i, 0) * out.f_B[0] + R_WB(i, 1) * out.f_B[1] + R_WB(i, 2) * out.f_B[2];
    out.v_dot_W[2] = out.v_dot_W[2] + vehicle_->g;
    const Vec4<S>& q = state.q_WB;  // (7)
    out.q_dot = Vec4<S>(
        0.5 * (-(q[1] * w[0]) - q[2] * w[1] - q[3] * w[2]), 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]),
        0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]), 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]));
    out.x_dot_W = state.v_W;
    return out;
  }

  static Mat3<S> inertia_matrix(std::span<const S> p) {
    Mat3<S> J;
    J(0, 0) = p[param::Jxx], J(1, 1) = p[param::Jyy], J(2, 2) = p[param::Jzz];
    J(0, 1) = J(1, 0) = p[param::Jxy];
    J(0, 2) = J(2, 0) = p[param::Jxz];
    J(1, 2) = J(2, 1) = p[param::Jyz];
    return J;
  }
  // Only the diagonal when there are no products of inertia.
  Vec3<S> times(const Mat3<S>& A, const Vec3<S>& x) const {
    if (diagonal_) return Vec3<S>(A(0, 0) * x[0], A(1, 1) * x[1], A(2, 2) * x[2]);
    return A * x;
  }
  static Vec3<S> turned_into_body(const Mat3<S>& R_WB, const Vec3<S>& v_W) {
    return Vec3<S>(dot(Vec3<S>(R_WB.col(0)), v_W), dot(Vec3<S>(R_WB.col(1)), v_W),
                   dot(Vec3<S>(R_WB.col(2)), v_W));
  }

  const Vehicle* vehicle_;
  std::span<const S> p_;
  const Effects* effects_;
  S m_, m_inverse_, Jp_;
  Mat3<S> J_, J_inverse_;
  Vec3<S> c_B_;
  AirSeam<S> air_;
  std::vector<Vec3<S>> a_B_;
  /// Constant vectors of a rotor: axis, moment of a unit thrust, axis times spin.
  struct Arm {
    Eigen::Vector3d a_B, moment_B, spin_B;
  };
  std::vector<Arm> arms_;
  S per_Omega_hover_ = S(1.0);
  bool off_centre_ = false, spinning_ = false, linear_drag_ = false, diagonal_ = false, plain_ = false,
       fixed_axes_ = true;
};

}  // namespace ident
