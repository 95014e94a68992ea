// The kernel itself, templated on an instruction set tag; included by one .cc per instruction set.
#pragma once

#include <cstring>

#include "ident/core/dual.h"
#include "ident/estimators/flight_kernel.h"

namespace ident {

/// Simulates a chunk on scalar S and hands every predicted measurement to `sink(row, channel, residual)`.
template <class Isa, class S>
class ChunkRun {
 public:
  using Effects = EffectSet<S>;

  ChunkRun(const ChunkTask& task, std::span<const S> p, const S* bias)
      : task_(task),
        effects_(p, task.active),
        flight_(*task.vehicle, p, effects_, *task.inputs),
        bias_(bias) {}

  template <class Sink>
  FlightState<S> operator()(FlightState<S> x, Sink&& sink) {
    const double* t = task_.t;
    delay_beyond_ = flight_.sensor_delay() - task_.shift;
    delayed_ = !is_identically_zero(delay_beyond_);
    const std::size_t last = task_.end;
    BodyRate<S> rate = flight_.rate(x, t[task_.begin]);
    std::size_t delayed_row = first_delayed_row();
    for (std::size_t i = task_.begin; i < last; ++i) {
      prompt_channels(i, x, rate, sink);
      if (task_.shift == 0) delayed_channels(i, x.body.w_B, rate.w_dot_B, x.body.q_WB, sink, x, rate);
      const int parts = 1 + static_cast<int>((t[i + 1] - t[i]) / task_.max_step);
      const double h = (t[i + 1] - t[i]) / parts;
      for (int part = 0; part < parts; ++part) {
        const double from = t[i] + part * h;
        const FlightState<S> before = x;
        const BodyRate<S> rate_before = rate;
        x = flight_.step(x, from, h, rate);
        rate = flight_.rate(x, from + h);
        if (task_.shift == 0) continue;
        const double to = part + 1 == parts ? t[i + 1] : from + h;
        while (delayed_row < rows_end() && t[delayed_row] - task_.shift < to) {
          interpolated_channels(delayed_row, (t[delayed_row] - task_.shift - from) / h, h, before,
                                rate_before, x, rate, sink);
          ++delayed_row;
        }
      }
    }
    return x;
  }

 private:
  std::size_t rows_end() const { return task_.rows; }

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
      const SensorSeam<S> imu = flight_.imu(x.body, rate);
      for (int k = 0; k < 3; ++k)
        if (sampled(i, kForce + k)) sink(i, kForce + k, S(imu.f_B[k] - y(i, kForce + k)));
    }
    for (int k = 0; k < 3; ++k) {
      if (sampled(i, kVelocity + k)) sink(i, kVelocity + k, S(x.body.v_W[k] - y(i, kVelocity + k)));
      if (sampled(i, kPosition + k)) sink(i, kPosition + k, S(x.body.x_W[k] - y(i, kPosition + k)));
    }
    if (task_.layout.motors < 0) return;
    for (int n = 0; n < task_.layout.rotors; ++n)
      if (sampled(i, kRotorChannel + n))
        sink(i, kRotorChannel + n, S(x.motors[static_cast<std::size_t>(n)].Omega - y(i, kRotorChannel + n)));
  }

  // Rates and attitude, which a sensor delay shifts: first order about `shift`.
  template <class Sink>
  void delayed_channels(std::size_t row, const Vec3<S>& w, const Vec3<S>& w_dot, const Vec4<S>& q, Sink& sink,
                        const FlightState<S>& x, const BodyRate<S>& rate) {
    if (sampled(row, kGyro) || sampled(row, kGyro + 1) || sampled(row, kGyro + 2)) {
      BodyState<S> then = x.body;
      then.w_B = w;
      if (delayed_) then.w_B -= delay_beyond_ * w_dot;
      const SensorSeam<S> imu = flight_.imu(then, rate);
      for (int k = 0; k < 3; ++k)
        if (sampled(row, kGyro + k)) sink(row, kGyro + k, S(imu.gyro[k] + bias_[k] - y(row, kGyro + k)));
    }
    if (sampled(row, kAttitude) && task_.layout.attitude >= 0) {
      const double* m = task_.q + 4 * row;
      const Vec4<double> inverse(m[0], -m[1], -m[2], -m[3]);
      Vec4<S> d = quaternion_product(inverse, q);
      const double sign = value(d[0]) < 0 ? -2.0 : 2.0;
      for (int k = 0; k < 3; ++k) {
        S turn = sign * d[1 + k];
        if (delayed_) turn = turn - delay_beyond_ * w[k];
        sink(row, kAttitude + k, turn);
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
    delayed_channels(row, w, w_dot, q, sink, a, ra);
  }

  const ChunkTask& task_;
  Effects effects_;
  Flight<S, Effects> flight_;
  const S* bias_;
  S delay_beyond_;
  bool delayed_ = false;
};

template <class Isa>
class ChunkKernel {
 public:
  static void evaluate(const ChunkTask& task, ChunkResult& out) {
    if (task.jacobian) {
      ChunkKernel(task, out).with_jacobian();
    } else {
      without_jacobian(task, out);
    }
  }

 private:
  ChunkKernel(const ChunkTask& task, ChunkResult& out)
      : task_(task), out_(out), d_(task.layout.size + task.thetas), packs_((d_ + 7) / 8) {
    packs_ = packs_ > dual_packs() ? packs_ : dual_packs();
  }

  // A pack of its own type for each instruction set, and aligned on the heap.
  struct alignas(64) AlignedPack {
    Pack8 pack;
  };

  static void count(ChunkResult& out, int channel, double r, double huber, double leverage) {
    const auto c = static_cast<std::size_t>(channel);
    const double clipped = r > huber ? huber : r < -huber ? -huber : r;
    out.square[c] += clipped * clipped;
    out.leverage[c] += leverage;
    out.count[c] += 1;
  }

  static void without_jacobian(const ChunkTask& task, ChunkResult& out) {
    out.cost = 0;
    out.square = out.leverage = out.count = {};
    const std::size_t size = (task.end - task.begin) * kChannels;
    if (out.residuals.size() != size) out.residuals.resize(size);
    for (std::size_t i = 0; i < size; ++i) out.residuals.data()[i] = __builtin_nan("");
    ChunkRun<Isa, double> run(task, task.p, task.gyro_bias.data());
    out.x_end = run(task.x0, [&](std::size_t row, int channel, double r) {
      r *= task.weight[channel];
      const double a = r < 0 ? -r : r;
      out.cost += a <= task.huber ? r * r : task.huber * (2 * a - task.huber);
      count(out, channel, r, task.huber, 0.0);
      if (row >= task.begin && row < task.end)
        out.residuals.data()[(row - task.begin) * kChannels + static_cast<std::size_t>(channel)] = r;
    });
  }

  void with_jacobian() {
    thread_local std::vector<AlignedPack> rows;
    const std::size_t most = (task_.end - task_.begin + 64) * kChannels;
    const auto stride = static_cast<std::size_t>(packs_);
    if (rows.size() < most * stride) rows = std::vector<AlignedPack>(most * stride);
    J_ = &rows.data()->pack;
    out_.cost = 0;
    out_.square = out_.leverage = out_.count = {};
    samples_ = 0;
    const std::size_t n = static_cast<std::size_t>(task_.layout.size), d = static_cast<std::size_t>(d_);
    resize(out_.A, d * d), resize(out_.g, d), resize(out_.E, n * d);
    for (double& x : out_.g) x = 0;
    int pack = 0;
    bool first = true;
    const int dual = dual_packs();
    while (pack < dual) {
      const int left = dual - pack;
      // Two widths only: each one is a whole copy of the model in the program.
      if (left >= 3)
        sweep<4>(pack, first), pack += 4;
      else
        sweep<1>(pack, first), pack += 1;
      first = false;
    }
    gyro_bias();
    square();
    if (task_.covariance) leverages();
  }

  static void resize(std::vector<double>& v, std::size_t n) {
    if (v.size() != n) v = std::vector<double>(n);
  }

  template <int K>
  void sweep(int pack, bool first) {
    using S = Dual<K, Isa>;
    const int from = 8 * pack, to = from + 8 * K;
    S p[kParameterCount], bias[3];
    for (int i = 0; i < kParameterCount; ++i) p[i] = S(task_.p.data()[i]);
    for (int k = 0; k < 3; ++k) bias[k] = S(task_.gyro_bias[static_cast<std::size_t>(k)]);
    const int n = task_.layout.size;
    for (const Seed& seed : task_.seeds) {
      const int at = n + seed.direction;
      if (at < from || at >= to) continue;
      if (seed.slot < kParameterCount) p[seed.slot].seed(at - from, seed.derivative);
    }
    ChunkRun<Isa, S> run(task_, std::span<const S>(p, static_cast<std::size_t>(kParameterCount)), bias);
    std::size_t sample = 0;
    Pack8 gradient[K] = {};
    const FlightState<S> end = run(seeded<S>(from, to), [&](std::size_t, int channel, const S& residual) {
      const double weight = task_.weight[channel], r = residual.v * weight, a = r < 0 ? -r : r;
      // Huber: beyond the bend the row is scaled so that J'J and J'r are those of rho.
      const double bend = a <= task_.huber ? 1.0 : __builtin_sqrt(task_.huber / a);
      Pack8* row = J_ + sample * static_cast<std::size_t>(packs_) + pack;
      const double scale = weight * bend;
      for (int k = 0; k < K; ++k) row[k] = residual.d[k] * scale;
      if (first) {
        out_.cost += a <= task_.huber ? r * r : task_.huber * (2 * a - task_.huber);
        count(out_, channel, r, task_.huber, 0.0);
      }
      for (int k = 0; k < K; ++k) gradient[k] += row[k] * (r * bend);
      if (first) sample_of(sample) = {scale, r * bend, channel};
      ++sample;
    });
    samples_ = sample;
    for (int i = 0; i < 8 * K && from + i < d_; ++i) out_.g.data()[from + i] = gradient[i / 8][i % 8];
    store_end(end, from);
    if (first) out_.x_end = values(end);
  }

  template <class S>
  FlightState<S> seeded(int from, int to) const {
    const FlightState<double>& x = task_.x0;
    const StateLayout& layout = task_.layout;
    FlightState<S> s;
    const auto seed = [&](S& scalar, int at, double derivative) {
      if (at >= from && at < to) scalar.seed(at - from, derivative);
    };
    for (int k = 0; k < 4; ++k) s.body.q_WB[k] = S(x.body.q_WB[k]);
    for (int k = 0; k < 3; ++k) {
      s.body.w_B[k] = S(x.body.w_B[k]), s.body.v_W[k] = S(x.body.v_W[k]), s.body.x_W[k] = S(x.body.x_W[k]);
      seed(s.body.w_B[k], layout.w + k, 1.0);
      if (layout.v >= 0) seed(s.body.v_W[k], layout.v + k, 1.0);
      if (layout.x >= 0) seed(s.body.x_W[k], layout.x + k, 1.0);
      if (layout.attitude < 0) continue;
      Vec4<double> half(0, 0, 0, 0);
      half[1 + k] = 0.5;
      const Vec4<double> dq = quaternion_product(x.body.q_WB, half);
      for (int i = 0; i < 4; ++i) seed(s.body.q_WB[i], layout.attitude + k, dq[i]);
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

  template <class S>
  void put_end(int row, const S& scalar, int from) {
    double* E = out_.E.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(d_);
    for (int i = 0; i < S::width && from + i < d_; ++i) E[from + i] = scalar.derivative(i);
  }

  template <class S>
  void store_end(const FlightState<S>& end, int from) {
    const StateLayout& layout = task_.layout;
    const Vec4<double> q(end.body.q_WB[0].v, end.body.q_WB[1].v, end.body.q_WB[2].v, end.body.q_WB[3].v);
    const Vec4<S> turn = quaternion_product(conjugate(q), end.body.q_WB);
    for (int k = 0; k < 3; ++k) {
      put_end(layout.w + k, end.body.w_B[k], from);
      if (layout.attitude >= 0) put_end(layout.attitude + k, S(2.0 * turn[1 + k]), from);
      if (layout.v >= 0) put_end(layout.v + k, end.body.v_W[k], from);
      if (layout.x >= 0) put_end(layout.x + k, end.body.x_W[k], from);
    }
    if (layout.motors < 0) return;
    for (int i = 0; i < layout.rotors; ++i) {
      put_end(layout.motors + i, end.motors[static_cast<std::size_t>(i)].Omega, from);
      put_end(layout.motors + layout.rotors + i, end.motors[static_cast<std::size_t>(i)].Omega_dot, from);
    }
  }

  template <class S>
  static FlightState<double> values(const FlightState<S>& s) {
    FlightState<double> x;
    for (int k = 0; k < 4; ++k) x.body.q_WB[k] = s.body.q_WB[k].v;
    for (int k = 0; k < 3; ++k) {
      x.body.w_B[k] = s.body.w_B[k].v, x.body.v_W[k] = s.body.v_W[k].v, x.body.x_W[k] = s.body.x_W[k].v;
    }
    for (std::size_t i = 0; i < kMaxRotors; ++i) x.motors[i] = {s.motors[i].Omega.v, s.motors[i].Omega_dot.v};
    return x;
  }

  // A = J'J by blocks of 8 x 8.
  void square() {
    const auto stride = static_cast<std::size_t>(packs_);
    for (int bi = 0; bi < packs_; ++bi) {
      for (int bk = 0; bk <= bi; ++bk) {
        Pack8 sum[8] = {};
        const Pack8 *left = J_ + bi, *right = J_ + bk;
        for (std::size_t s = 0; s < samples_; ++s, left += stride, right += stride) {
          const Pack8 a = *left, b = *right;
          for (int i = 0; i < 8; ++i) sum[i] += a[i] * b;
        }
        for (int i = 0; i < 8; ++i)
          for (int k = 0; k < 8; ++k) {
            const int r = 8 * bi + i, c = 8 * bk + k;
            if (r >= d_ || c >= d_) continue;
            out_.A.data()[r * d_ + c] = sum[i][k];
            out_.A.data()[c * d_ + r] = sum[i][k];
          }
      }
    }
  }

  // Leverage of each sample with respect to the local state: j P j'.
  void leverages() {
    const int n = task_.layout.size;
    const auto stride = static_cast<std::size_t>(packs_) * 8;
    const double* J = reinterpret_cast<const double*>(J_);
    for (std::size_t s = 0; s < samples_; ++s) {
      const double* j = J + s * stride;
      double sum = 0;
      for (int a = 0; a < n; ++a) {
        double row = 0;
        for (int b = 0; b < n; ++b) row += task_.covariance[a * n + b] * j[b];
        sum += j[a] * row;
      }
      out_.leverage[static_cast<std::size_t>(sample_of(s).channel)] += sum;
    }
  }

  // The gyro bias adds to the rates as shown, so its derivative needs no dual number.
  void gyro_bias() {
    const int dual = dual_packs();
    const auto stride = static_cast<std::size_t>(packs_);
    for (std::size_t s = 0; s < samples_ && dual < packs_; ++s)
      for (int k = dual; k < packs_; ++k) J_[s * stride + static_cast<std::size_t>(k)] = Pack8{};
    const std::size_t n = static_cast<std::size_t>(task_.layout.size), d = static_cast<std::size_t>(d_);
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 8 * static_cast<std::size_t>(dual); c < d; ++c) out_.E.data()[r * d + c] = 0;
    for (const Seed& seed : task_.seeds) {
      if (seed.slot < kParameterCount) continue;
      const auto at = static_cast<std::size_t>(task_.layout.size + seed.direction);
      double sum = 0;
      for (std::size_t s = 0; s < samples_; ++s) {
        const Sample& sample = sample_of(s);
        if (sample.channel != kGyro + seed.slot - kParameterCount) continue;
        const double slope = seed.derivative * sample.scale;
        J_[s * stride + at / 8][at % 8] = slope;
        sum += slope * sample.residual;
      }
      out_.g.data()[at] = sum;
    }
  }

  // Packs that hold a direction of the state or of a constant of the model.
  int dual_packs() const {
    int last = task_.layout.size;
    for (const Seed& seed : task_.seeds)
      if (seed.slot < kParameterCount && task_.layout.size + seed.direction + 1 > last)
        last = task_.layout.size + seed.direction + 1;
    const int packs = (last + 7) / 8;
    // Three packs are done by a sweep of four.
    return packs % 4 == 3 ? packs + 1 : packs;
  }

  struct Sample {
    double scale = 0, residual = 0;
    int channel = 0;
  };
  Sample& sample_of(std::size_t sample) {
    thread_local std::vector<Sample> samples;
    if (samples.size() <= sample) {
      std::vector<Sample> more(2 * sample + 4096);
      for (std::size_t i = 0; i < samples.size(); ++i) more.data()[i] = samples.data()[i];
      samples.swap(more);
    }
    return samples.data()[sample];
  }

  const ChunkTask& task_;
  ChunkResult& out_;
  int d_, packs_;
  Pack8* J_ = nullptr;
  std::size_t samples_ = 0;
};

}  // namespace ident
