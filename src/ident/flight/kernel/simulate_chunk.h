// Simulates a chunk of flight on any scalar and hands out its predictions row by row.
#pragma once

#include "ident/core/dual.h"
#include "ident/flight/kernel/kernel.h"
#include "ident/model/within_step.h"

namespace ident {

/// Counts a weighted residual, clipped at `huber`.
template <class Isa>
void count_residual(ChunkResult& out, int channel, double r, double huber) {
  const auto c = static_cast<std::size_t>(channel);
  const double clipped = r > huber ? huber : r < -huber ? -huber : r;
  out.square.data()[c] += clipped * clipped;
  out.count.data()[c] += 1;
}

/// Simulates a chunk on scalar S and hands every predicted measurement to `sink(row, channel, residual)`.
template <class Isa, class S>
class ChunkRun {
 public:
  using Effects = EffectSet<S>;

  ChunkRun(const ChunkTask& task, std::span<const S> p, EffectMask effects, const S* bias)
      : task_(task), effects_(p, effects), flight_(*task.vehicle, p, effects_, *task.inputs), bias_(bias) {
    flight_.feel_outside(task.layout.w_dot >= 0);
    flight_.step_to_order(task.steps == Steps::fine ? 4 : 2);
  }

  /// Attitude at the row that was handed to the sink last (specific force, velocity, position).
  const Vec4<S>& attitude() const { return now_->body.q_WB; }

  template <class Sink>
  FlightState<S> operator()(FlightState<S> x, Sink&& sink) {
    now_ = &x;
    const double* t = task_.t;
    delay_beyond_ = flight_.sensor_delay() - task_.shift;
    delayed_ = !is_identically_zero(delay_beyond_);
    const std::size_t last = task_.end;
    flight_.drop_fast_mode(x.motors, t[task_.begin], t[task_.begin + 1] - t[task_.begin]);
    BodyRate<S> rate = flight_.rate(x, t[task_.begin]);
    std::size_t delayed_row = first_delayed_row();
    for (std::size_t i = task_.begin, next = i; i < last; i = next) {
      prompt_channels(i, x, rate, sink);
      if (task_.shift == 0) delayed_channels(i, x.body.w_B, rate.w_dot_B, x.body.q_WB, sink, rate);
      next = row_after(i);
      const int parts = 1 + static_cast<int>((t[next] - t[i]) / longest_step());
      const double h = (t[next] - t[i]) / parts;
      for (int part = 0; part < parts; ++part) {
        const double from = t[i] + part * h;
        if (task_.shift == 0 && next == i + 1) {
          flight_.step_on(x, from, h, rate);
          continue;
        }
        const FlightState<S> before = x;
        const BodyRate<S> rate_before = rate;
        StepMiddle<S> middle;
        flight_.step_on(x, from, h, rate, middle);
        const WithinStep<S> within(h, before, rate_before, middle, x, rate);
        if (next > i + 1) rows_within(i + 1, next, within, from, h, sink);
        if (task_.shift == 0) continue;
        const double to = part + 1 == parts ? t[next] : from + h;
        for (; delayed_row < rows_end() && t[delayed_row] - task_.shift < to; ++delayed_row) {
          const double u = (t[delayed_row] - task_.shift - from) / h;
          if (task_.steps == Steps::fine)
            interpolated_channels(delayed_row, u, h, before, rate_before, x, rate, sink);
          else
            delayed_channels_within(delayed_row, u, within, sink);
        }
      }
    }
    return x;
  }

 private:
  std::size_t rows_end() const { return task_.rows; }

  // Measured speeds are no smoother than their rows: no long steps with them.
  bool long_steps() const { return task_.steps == Steps::longest && task_.inputs->commanded(); }
  double longest_step() const {
    return long_steps() && kLongStep > task_.max_step ? kLongStep : task_.max_step;
  }

  // The row up to which one step reaches. None reaches over several rows where commands jump, nor right
  // after: a jump acts as a line over its step, and at the end of that line fast motors change their speed
  // otherwise than after the jump.
  std::size_t row_after(std::size_t i) const {
    std::size_t next = i + 1;
    if (!long_steps()) return next;
    const double least = next_jump(i > 0 ? task_.t[i - 1] : task_.t[i]);
    const double to = least < task_.t[i] + longest_step() ? least : task_.t[i] + longest_step();
    while (next < task_.end && task_.t[next + 1] < to) ++next;
    return next;
  }

  // When motors feel the first jump of the commands after t; without one, never.
  double next_jump(double t) const {
    const std::vector<double>& jumps = task_.inputs->jumps;
    const std::size_t n = jumps.size();
    if (n == 0) return 1e300;
    const double delay = value(flight_.command_delay());
    const std::size_t before = row_before<S>(jumps.data(), n, t - delay);
    const std::size_t next = jumps.data()[before] > t - delay ? before : before + 1;
    return next < n ? jumps.data()[next] + delay : 1e300;
  }

  // Predicts the rows that lie within one step.
  template <class Sink>
  void rows_within(std::size_t begin, std::size_t end, const WithinStep<S>& step, double from, double h,
                   Sink& sink) {
    const FlightState<S>* after = now_;
    FlightState<S> here;
    now_ = &here;
    for (std::size_t i = begin; i < end; ++i) {
      const double u = (task_.t[i] - from) / h;
      here.body = step.body(u);
      for (int n = 0; n < task_.layout.rotors && task_.layout.motors >= 0; ++n)
        if (sampled(i, kRotorChannel + n))
          here.motors[static_cast<std::size_t>(n)].Omega = step.speed(u, static_cast<std::size_t>(n));
      const BodyRate<S> rate = step.rate(u);
      prompt_channels(i, here, rate, sink);
      if (task_.shift == 0) delayed_channels(i, here.body.w_B, rate.w_dot_B, here.body.q_WB, sink, rate);
    }
    now_ = after;
  }

  template <class Sink>
  void delayed_channels_within(std::size_t row, double u, const WithinStep<S>& step, Sink& sink) {
    const BodyState<S> body = step.body(u);
    const BodyRate<S> rate = step.rate(u);
    delayed_channels(row, body.w_B, rate.w_dot_B, body.q_WB, sink, rate);
  }

  std::size_t first_delayed_row() const {
    std::size_t row = task_.begin;
    if (task_.shift == 0) return row;
    while (row < rows_end() && task_.t[row] - task_.shift < task_.t[task_.begin]) ++row;
    return row;
  }

  bool sampled(std::size_t row, int channel) const {
    const double y = task_.y[row * kChannels + static_cast<std::size_t>(channel)];
    return y == y;
  }
  double y(std::size_t row, int channel) const {
    return task_.y[row * kChannels + static_cast<std::size_t>(channel)];
  }

  template <class Sink>
  void prompt_channels(std::size_t i, const FlightState<S>& x, const BodyRate<S>& rate, Sink& sink) {
    if (sampled(i, kForce) || sampled(i, kForce + 2)) {
      const SensorSeam<S> imu = flight_.imu(x.body.w_B, rate);
      for (int k = 0; k < 3; ++k)
        if (sampled(i, kForce + k)) sink(i, kForce + k, S(imu.f_B[k] - y(i, kForce + k)));
    }
    for (int k = 0; k < 3; ++k) {
      const double v = y(i, kVelocity + k) - task_.x0.shown_error[kShownVelocity][k],
                   at = y(i, kPosition + k) - task_.x0.shown_error[kShownPosition][k];
      if (v == v) sink(i, kVelocity + k, S(x.body.v_W[k] - v));
      if (at == at) sink(i, kPosition + k, S(x.body.x_W[k] - at));
    }
    if (task_.layout.motors < 0) return;
    for (int n = 0; n < task_.layout.rotors; ++n)
      if (sampled(i, kRotorChannel + n))
        sink(i, kRotorChannel + n, S(x.motors[static_cast<std::size_t>(n)].Omega - y(i, kRotorChannel + n)));
  }

  // Rates and attitude, which a sensor delay shifts: first order about `shift`.
  template <class Sink>
  void delayed_channels(std::size_t row, const Vec3<S>& w, const Vec3<S>& w_dot, const Vec4<S>& q, Sink& sink,
                        const BodyRate<S>& rate) {
    if (sampled(row, kGyro) || sampled(row, kGyro + 1) || sampled(row, kGyro + 2)) {
      const SensorSeam<S> imu = flight_.imu(delayed_ ? Vec3<S>(w - delay_beyond_ * w_dot) : w, rate);
      for (int k = 0; k < 3; ++k)
        if (sampled(row, kGyro + k)) sink(row, kGyro + k, S(imu.gyro[k] + bias_[k] - y(row, kGyro + k)));
    }
    if (sampled(row, kAttitude) && task_.layout.attitude >= 0) {
      const double* m = task_.q + 4 * row;
      // d = conjugate(m) * q, of which the turn is twice the vector.
      const double d0 = m[0] * value(q[0]) + m[1] * value(q[1]) + m[2] * value(q[2]) + m[3] * value(q[3]);
      const double twice = d0 < 0 ? -2.0 : 2.0;
      for (int k = 0; k < 3; ++k) {
        const int own = 1 + k, next = 1 + (k + 1) % 3, last = 1 + (k + 2) % 3;
        S turn = sum(sum(sum(S((twice * m[0]) * q[own]), -twice * m[own], q[0]), -twice * m[next], q[last]),
                     twice * m[last], q[next]);
        if (delayed_) turn = turn - delay_beyond_ * w[k];
        sink(row, kAttitude + k, S(turn + task_.x0.shown_error[kShownAttitude][k]));
      }
    }
  }

  // Cubic Hermite interpolation of rates and attitude at the fraction `u` of a step of h seconds.
  template <class Sink>
  void interpolated_channels(std::size_t row, double u, double h, const FlightState<S>& a,
                             const BodyRate<S>& ra, const FlightState<S>& b, const BodyRate<S>& rb,
                             Sink& sink) {
    const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h01 = u * u * (3 - 2 * u);
    const double h10 = u * (1 - u) * (1 - u) * h, h11 = u * u * (u - 1) * h;
    const Vec3<S> w = h00 * a.body.w_B + h01 * b.body.w_B + h10 * ra.w_dot_B + h11 * rb.w_dot_B;
    const Vec3<S> w_dot = (1 - u) * ra.w_dot_B + u * rb.w_dot_B;
    const Vec4<S> q = h00 * a.body.q_WB + h01 * b.body.q_WB + h10 * ra.q_dot + h11 * rb.q_dot;
    delayed_channels(row, w, w_dot, q, sink, ra);
  }

  const ChunkTask& task_;
  Effects effects_;
  Flight<S, Effects> flight_;
  const S* bias_;
  const FlightState<S>* now_ = nullptr;
  S delay_beyond_;
  bool delayed_ = false;
};

}  // namespace ident
