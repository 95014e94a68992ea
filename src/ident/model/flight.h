// One step of the whole vehicle: motors exactly, body by Runge-Kutta 4, or at half the cost by Simpson's
// rule, with the rotor speeds of that solution.
#pragma once

#include <array>
#include <vector>

#include "ident/model/body.h"

namespace ident {

/// Longest step of an estimator, s; longer ones between rows are split evenly. A command that changes within
/// a step acts as a line over it: over 10 ms that puts a dead time off by a fiftieth.
inline constexpr double kEstimatorStep = 4.6e-3;

constexpr int kMaxRotors = 8;

/// Steps that differ by less are alike to a motor, s: times that were written down differ by rounding.
inline constexpr double kSameStep = 1e-12;

/// The same of the longest steps, of order 2, which may reach over several rows of a log.
inline constexpr double kLongStep = 10.5e-3;

/// What comes from outside over a log: commands or measured rotor speeds, and the battery.
struct FlightInputs {
  double t0 = 0.0;                         ///< start of the log, s
  std::vector<HeldCommand> delta;          ///< per rotor; empty when rotor speeds are the input
  std::vector<double> jumps;               ///< when commands change that are held for long in between, s
  std::vector<double> t;                   ///< times of the columns below
  std::vector<std::vector<double>> Omega;  ///< [rotor][row], used when `delta` is empty; interpolated
  std::vector<double> voltage_ratio;       ///< vbat over the voltage at which km holds; empty when not logged

  bool commanded() const { return !delta.empty(); }
};

/// What an estimator may show with a slow error: attitude, about the axes of the body; velocity and position,
/// in the world.
enum ShownGroup : int { kShownAttitude, kShownVelocity, kShownPosition, kShownGroups };

/// Whole state: body and motors; and by how much what is shown of it is off, rad, m/s, m.
template <class S>
struct FlightState {
  BodyState<S> body;
  std::array<MotorState<S>, kMaxRotors> motors{};
  Disturbance<S> outside;
  Vec3<double> shown_error[kShownGroups] = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
};

/// Half way through a step: the motors, and the body's rate as the step took it.
template <class S>
struct StepMiddle {
  std::array<MotorState<S>, kMaxRotors> motors;
  BodyRate<S> rate;
};

/// The vehicle with one set of constants, able to make steps.
template <class S, class Effects = NoEffects>
class Flight {
 public:
  Flight(const Vehicle& vehicle, std::span<const S> p, const Effects& effects, const FlightInputs& inputs)
      : body_(vehicle, p, effects),
        p_(p),
        effects_(&effects),
        inputs_(&inputs),
        rotors_(vehicle.rotors.size()) {
    delays_ = {p[param::dead_time], S(0.0)};
    effects.apply(delays_);
    constant_delay_ = is_constant(delays_.command_delay);
    gain_ = (effects.touches() & kTouchGain) != 0;
    asymmetric_ = (effects.touches() & kTouchAsymmetry) != 0;
    DriveSeam<S> drive{0.0, 1.0, false, S(1.0), S(1.0)};
    effects.apply(drive);
    down_ratio_ = drive.down_ratio;
  }

  const Body<S, Effects>& body() const { return body_; }

  /// Whether `outside` of a state acts; off at first.
  void feel_outside(bool on) { outside_ = on; }
  /// Order of the steps: 4, or 2 at half the cost.
  void step_to_order(int order) { order_ = order; }
  const S& sensor_delay() const { return delays_.sensor_delay; }
  const S& command_delay() const { return delays_.command_delay; }

  /// Moves a state h seconds on; `rate` is that at its start, and then that at its end.
  void step_on(FlightState<S>& x, double t, double h, BodyRate<S>& rate) {
    StepMiddle<S> middle;
    step_on(x, t, h, rate, middle);
  }

  /// The same; `middle` is what a state within the step can be read off, its rate in steps of order 2 only.
  void step_on(FlightState<S>& x, double t, double h, BodyRate<S>& rate, StepMiddle<S>& middle) {
    std::array<MotorState<S>, kMaxRotors> felt;  // half way, where that is not as the motors are
    const bool averaged = body_.spinning() && is_fast(h);
    if (averaged) felt = x.motors;
    advance_motors(x.motors, t, h / 2, middle.motors);
    advance_motors(middle.motors, t + h / 2, h / 2, x.motors);
    if (averaged) average_speeding(felt, middle.motors, x.motors, h);
    const std::span<const MotorState<S>> mid(averaged ? felt.data() : middle.motors.data(), rotors_),
        end(x.motors.data(), rotors_);
    if (body_.plain())
      runge_kutta(x, h, rate, body_.rotor_sums(mid), body_.rotor_sums(end), middle.rate);
    else
      runge_kutta(x, h, rate, mid, end, middle.rate);
  }

  /// The state h seconds on; `at_start` is the rate of `x`.
  FlightState<S> step(const FlightState<S>& x, double t, double h, const BodyRate<S>& at_start) {
    FlightState<S> next = x;
    BodyRate<S> rate = at_start;
    step_on(next, t, h, rate);
    return next;
  }

  /// Rates of change at a state. With measured rotor speeds as input the motors of `x` are set from them
  /// first.
  BodyRate<S> rate(FlightState<S>& x, double t) const {
    if (!inputs_->commanded()) measured_motors(t, x.motors);
    return body_.rate(x.body, std::span<const MotorState<S>>(x.motors.data(), rotors_),
                      outside_ ? &x.outside : nullptr);
  }

  /// Steady motor speeds for the command that holds at t: a start when nothing else is known.
  S steady_speed(std::size_t rotor, double t) const { return target(rotor, t, 1e-6).mean; }

  /// Takes out of the motors' state at time t what dies away far within a step of h seconds: of motors with
  /// two real poles the part of the fast one, Omega - T = A exp(slow t) + B exp(fast t). A step would carry B
  /// on as a push that lasts for much of it.
  void drop_fast_mode(std::array<MotorState<S>, kMaxRotors>& motors, double t, double h) const {
    constexpr double kSettled = 20.0;  // time constants in a step: exp(-20) is left
    using std::sqrt;
    const S &omega_m = p_[param::omega_m], &zeta_m = p_[param::zeta_m];
    if (!inputs_->commanded() || !(value(zeta_m) > 1.0)) return;
    const S root = sqrt(zeta_m * zeta_m - 1.0), slow = -(omega_m / (zeta_m + root)),
            fast = -(omega_m * (zeta_m + root));
    if (!(-h * value(fast) > kSettled)) return;
    for (std::size_t n = 0; n < rotors_; ++n) {
      MotorState<S>& motor = motors[n];
      const S T = steady_speed(n, t), y = motor.Omega - T;
      const S ratio = asymmetric_ && value(y) > 0 ? down_ratio_ : S(1.0);
      motor.Omega = motor.Omega - (motor.Omega_dot - ratio * slow * y) / (ratio * (fast - slow));
      motor.Omega_dot = ratio * slow * (motor.Omega - T);
    }
  }

  /// The motors alone, h seconds on.
  void advance(std::array<MotorState<S>, kMaxRotors>& motors, double t, double h) {
    const std::array<MotorState<S>, kMaxRotors> from = motors;
    advance_motors(from, t, h, motors);
  }

  /// What the IMU shows at a body rate with that rate of change; gyro bias is added by the caller.
  SensorSeam<S> imu(const Vec3<S>& w_B, const BodyRate<S>& rate) const {
    SensorSeam<S> seam{w_B, rate.w_dot_B, rate.f_B, w_B};
    effects_->apply(seam);
    return seam;
  }

 private:
  // `Rotors`: the motors, or what they sum up to.
  template <class Rotors>
  void runge_kutta(FlightState<S>& x, double h, BodyRate<S>& rate, const Rotors& mid, const Rotors& end,
                   BodyRate<S>& k2) const {
    const BodyRate<S>& k1 = rate;
    const Disturbance<S>* outside = outside_ ? &x.outside : nullptr;
    k2 = body_.rate(moved(x.body, k1, h / 2), mid, outside);
    if (order_ == 2) return simpson(x, h, rate, k2, end);
    const BodyRate<S> k3 = body_.rate(moved(x.body, k2, h / 2), mid, outside);
    const BodyRate<S> k4 = body_.rate(moved(x.body, k3, h), end, outside);
    x.body.q_WB = combined(x.body.q_WB, h, k1.q_dot, k2.q_dot, k3.q_dot, k4.q_dot);
    x.body.w_B = combined(x.body.w_B, h, k1.w_dot_B, k2.w_dot_B, k3.w_dot_B, k4.w_dot_B);
    x.body.v_W = combined(x.body.v_W, h, k1.v_dot_W, k2.v_dot_W, k3.v_dot_W, k4.v_dot_W);
    x.body.x_W = combined(x.body.x_W, h, k1.x_dot_W, k2.x_dot_W, k3.x_dot_W, k4.x_dot_W);
    rate = body_.rate(x.body, end, outside);
  }

  // Simpson's rule over the rates at the start, half way, and where the midpoint rule ends, off by h^3; that
  // serves for the rate of the next step as well. Of second order on the whole.
  template <class Rotors>
  void simpson(FlightState<S>& x, double h, BodyRate<S>& rate, const BodyRate<S>& k2,
               const Rotors& end) const {
    const BodyRate<S>& k1 = rate;
    const BodyRate<S> k3 = body_.rate(moved(x.body, k2, h), end, outside_ ? &x.outside : nullptr);
    x.body.q_WB = combined(x.body.q_WB, h, k1.q_dot, k2.q_dot, k3.q_dot);
    x.body.w_B = combined(x.body.w_B, h, k1.w_dot_B, k2.w_dot_B, k3.w_dot_B);
    x.body.v_W = combined(x.body.v_W, h, k1.v_dot_W, k2.v_dot_W, k3.v_dot_W);
    x.body.x_W = combined(x.body.x_W, h, k1.x_dot_W, k2.x_dot_W, k3.x_dot_W);
    rate = k3;
  }

  static BodyState<S> moved(const BodyState<S>& x, const BodyRate<S>& k, double h) {
    return {sum(x.q_WB, h, k.q_dot), sum(x.w_B, h, k.w_dot_B), sum(x.v_W, h, k.v_dot_W),
            sum(x.x_W, h, k.x_dot_W)};
  }

  // Whether speeds may change otherwise within h seconds than a parabola through three of their rates.
  bool is_fast(double h) const {
    constexpr double kFast = 0.5;
    const double omega_m = value(p_[param::omega_m]), zeta_m = value(p_[param::zeta_m]);
    return h * omega_m * (zeta_m > 0.5 ? 2 * zeta_m : 1.0) > kFast;
  }

  // What turns the body as rotors speed up sums up to their change of speed. By Simpson's rule over the rates
  // at the start, half way and at the end it does so with this rate half way. `felt`: at the start, then half
  // way.
  void average_speeding(std::array<MotorState<S>, kMaxRotors>& felt,
                        const std::array<MotorState<S>, kMaxRotors>& middle,
                        const std::array<MotorState<S>, kMaxRotors>& end, double h) const {
    for (std::size_t n = 0; n < rotors_; ++n)
      felt[n] = {middle[n].Omega,
                 (1.5 / h) * (end[n].Omega - felt[n].Omega) - 0.25 * (felt[n].Omega_dot + end[n].Omega_dot)};
  }

  // x + h/6 (a + 2 b + 2 c + d)
  template <int N>
  static Eigen::Matrix<S, N, 1> combined(const Eigen::Matrix<S, N, 1>& x, double h,
                                         const Eigen::Matrix<S, N, 1>& a, const Eigen::Matrix<S, N, 1>& b,
                                         const Eigen::Matrix<S, N, 1>& c, const Eigen::Matrix<S, N, 1>& d) {
    return sum(sum(sum(sum(x, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }

  // x + h/6 (a + 4 b + c)
  template <int N>
  static Eigen::Matrix<S, N, 1> combined(const Eigen::Matrix<S, N, 1>& x, double h,
                                         const Eigen::Matrix<S, N, 1>& a, const Eigen::Matrix<S, N, 1>& b,
                                         const Eigen::Matrix<S, N, 1>& c) {
    return sum(sum(sum(x, h / 6, a), 2 * h / 3, b), h / 6, c);
  }

  double interpolated(const std::vector<double>& column, double t) const {
    const double *axis = inputs_->t.data(), *y = column.data();
    const std::size_t n = inputs_->t.size(), i = row_before<S>(axis, n, t);
    if (t <= axis[0] || i + 1 == n) return y[i];
    return y[i] + (t - axis[i]) / (axis[i + 1] - axis[i]) * (y[i + 1] - y[i]);
  }

  void measured_motors(double t, std::array<MotorState<S>, kMaxRotors>& motors) const {
    constexpr double dt = 2e-3;
    for (std::size_t n = 0; n < rotors_; ++n) {
      const double before = interpolated(inputs_->Omega[n], t - dt),
                   after = interpolated(inputs_->Omega[n], t + dt);
      motors[n] = {S(interpolated(inputs_->Omega[n], t)), S((after - before) / (2 * dt))};
    }
  }

  // Right-hand side of (1) over omega_m^2 as a line over the step: Omega_0 + km delta, with the drive seam.
  CommandLine<S> target(std::size_t rotor, double t, double h) const {
    const HeldCommand& command = inputs_->delta[rotor];
    CommandLine<S> goal;
    const auto set = [&](const auto& line) {
      goal.mean = p_[param::Omega_0] + line.mean * p_[param::km];
      goal.bent = line.bent;
      if (line.bent) goal.slope = line.slope * p_[param::km];
    };
    if (constant_delay_)
      set(command.template line<S>(t, t + h, value(delays_.command_delay)));
    else
      set(command.template line<S>(t, t + h, delays_.command_delay));
    if (!gain_) return goal;
    DriveSeam<S> drive{t - inputs_->t0, 1.0, !inputs_->voltage_ratio.empty(), S(1.0), S(1.0)};
    if (drive.has_voltage) drive.voltage_ratio = interpolated(inputs_->voltage_ratio, t + h / 2);
    effects_->apply(drive);
    goal.mean = goal.mean * drive.gain;
    if (goal.bent) goal.slope = goal.slope * drive.gain;
    return goal;
  }

  static MotorState<S> followed(const MotorTransition<S>& transition, const MotorState<S>& from,
                                const CommandLine<S>& goal, const S& lag, double h) {
    return goal.bent ? transition(from, S(goal.mean - (h / 2) * goal.slope), goal.slope, lag, h)
                     : transition(from, goal.mean);
  }

  void advance_motors(const std::array<MotorState<S>, kMaxRotors>& from, double t, double h,
                      std::array<MotorState<S>, kMaxRotors>& to) {
    if (!inputs_->commanded()) return measured_motors(t + h, to);
    if (!(std::abs(h - h_) < kSameStep)) {
      h_ = h;
      up_ = motor_transition(p_[param::omega_m], p_[param::zeta_m], h);
      lag_ = 2.0 * p_[param::zeta_m] / p_[param::omega_m];
      if (asymmetric_) down_ = motor_transition(S(p_[param::omega_m] * down_ratio_), p_[param::zeta_m], h);
    }
    for (std::size_t n = 0; n < rotors_; ++n) {
      const CommandLine<S> goal = target(n, t, h);
      to[n] = followed(up_, from[n], goal, lag_, h);
      if (!asymmetric_) continue;
      // The slower natural frequency holds while the rotor is above its target; blended over 2 rad/s so that
      // the change has a derivative.
      using std::exp;
      const S excess = 0.5 * (from[n].Omega - goal.mean);
      const S share = value(excess) > 30    ? S(1.0)
                      : value(excess) < -30 ? S(0.0)
                                            : S(1.0 / (1.0 + exp(-excess)));
      const MotorState<S> slow = followed(down_, from[n], goal, S(lag_ / down_ratio_), h);
      to[n].Omega = to[n].Omega + share * (slow.Omega - to[n].Omega);
      to[n].Omega_dot = to[n].Omega_dot + share * (slow.Omega_dot - to[n].Omega_dot);
    }
  }

  Body<S, Effects> body_;
  std::span<const S> p_;
  const Effects* effects_;
  const FlightInputs* inputs_;
  std::size_t rotors_;
  TimeSeam<S> delays_;
  S down_ratio_, lag_;
  int order_ = 4;
  bool asymmetric_ = false, gain_ = false, outside_ = false, constant_delay_ = false;
  double h_ = -1.0;
  MotorTransition<S> up_, down_;
};

}  // namespace ident
