// The kernel itself, templated on an instruction set tag; included by one .cc per instruction set.
#pragma once

#include <cstring>

#include "ident/estimators/flight_chunk_run.h"

namespace ident {

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
      : task_(task), out_(out), d_(task.layout.size + task.thetas) {
    list_columns();
  }

  // A column of J: `external` is its place in the caller's order, state first, then shared unknowns.
  // Internally those that need dual numbers come first; the others follow from the time since the chunk's
  // start.
  enum class Kind { dual, position, velocity, push, bias };
  struct Column {
    int external = -1, axis = 0;
    Kind kind = Kind::dual;
    double derivative = 1.0;
  };

  void list_columns() {
    const StateLayout& layout = task_.layout;
    // Without drag or effects off their null values nothing depends on velocity and position, and nothing
    // stands between an acceleration and the accelerometer.
    const bool plain = task_.active == 0 && task_.p.data()[param::Kdx] == 0 &&
                       task_.p.data()[param::Kdy] == 0 && task_.p.data()[param::Kdz] == 0 &&
                       !seeded_with(param::Kdx) && !seeded_with(param::Kdy) && !seeded_with(param::Kdz);
    const auto within = [](int i, int first) { return first >= 0 && i >= first && i < first + 3; };
    const auto kind_of = [&](int i) {
      if (plain && within(i, layout.x)) return Kind::position;
      if (plain && within(i, layout.v)) return Kind::velocity;
      if (plain && within(i, layout.v_dot)) return Kind::push;
      return Kind::dual;
    };
    place_ = table<Place>(static_cast<std::size_t>(d_));
    column_ = table<Column>(static_cast<std::size_t>(d_) + 64);
    for (int i = 0; i < d_; ++i) place_[i] = {-1};
    columns_ = 0;
    const auto add = [&](const Column& column) {
      place_[column.external].at = columns_;
      column_[columns_++] = column;
    };
    for (int i = 0; i < layout.size; ++i)
      if (kind_of(i) == Kind::dual) add({i, 0, Kind::dual, 1.0});
    for (const Seed& seed : task_.seeds)
      if (seed.slot < kParameterCount) add({layout.size + seed.direction, 0, Kind::dual, seed.derivative});
    // The rest of the packs of dual numbers stays empty: sweeps are 32 columns wide, or 16 in single
    // precision.
    dual_packs_ = task_.exact ? 4 * ((columns_ + 31) / 32) : 2 * ((columns_ + 15) / 16);
    while (columns_ < 8 * dual_packs_) column_[columns_++] = {-1, 0, Kind::dual, 0.0};
    for (int i = 0; i < layout.size; ++i) {
      const int first = kind_of(i) == Kind::position   ? layout.x
                        : kind_of(i) == Kind::velocity ? layout.v
                                                       : layout.v_dot;
      if (kind_of(i) != Kind::dual) add({i, i - first, kind_of(i), 1.0});
    }
    for (const Seed& seed : task_.seeds)
      if (seed.slot >= kParameterCount)
        add({layout.size + seed.direction, seed.slot - kParameterCount, Kind::bias, seed.derivative});
    packs_ = (columns_ + 7) / 8;
    while (columns_ < 8 * packs_) column_[columns_++] = {-1, 0, Kind::dual, 0.0};
  }

  bool seeded_with(int slot) const {
    for (const Seed& seed : task_.seeds)
      if (seed.slot == slot) return true;
    return false;
  }

  // Packs of types of their own for each instruction set, and aligned on the heap.
  struct alignas(64) AlignedPack {
    Pack8 pack;
  };
  struct alignas(64) AlignedCovariance {
    Pack8 pack;
  };
  struct alignas(64) AlignedSum {
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
    ChunkRun<Isa, double> run(task, task.p, task.active, task.gyro_bias.data());
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
    const std::size_t most = (task_.end - task_.begin + 64) * kChannels;
    J_ = &table<AlignedPack>(most * static_cast<std::size_t>(packs_))->pack;
    sample_ = table<Sample>(most);
    out_.cost = 0;
    out_.square = out_.leverage = out_.count = {};
    samples_ = 0;
    const std::size_t n = static_cast<std::size_t>(task_.layout.size), d = static_cast<std::size_t>(d_);
    resize(out_.A, d * d), resize(out_.g, d), resize(out_.E, n * d);
    for (double& x : out_.A) x = 0;
    for (double& x : out_.g) x = 0;
    for (double& x : out_.E) x = 0;
    int pack = 0;
    bool first = true;
    while (pack < dual_packs_) {
      const int left = dual_packs_ - pack;
      // Three kinds only: each one is a whole copy of the model in the program.
      if (task_.exact)
        sweep<Dual<4, Isa, double>>(pack, first), pack += 4;
      else if (left >= 4)
        sweep<Dual<2, Isa, float>>(pack, first), pack += 4;
      else
        sweep<Dual<1, Isa, float>>(pack, first), pack += 2;
      first = false;
    }
    analytic_gradient();
    square();
    if (task_.covariance) leverages();
  }

  static void resize(std::vector<double>& v, std::size_t n) {
    if (v.size() != n) v = std::vector<double>(n);
  }

  template <class S>
  void sweep(int pack, bool first) {
    constexpr int packs = S::width / 8;
    const int from = 8 * pack, to = from + S::width;
    EffectMask effects = task_.active;  // those off their null values, and those of this sweep's directions
    S p[kParameterCount], bias[3];
    for (int i = 0; i < kParameterCount; ++i) p[i] = S(task_.p.data()[i]);
    for (int k = 0; k < 3; ++k) bias[k] = S(task_.gyro_bias[static_cast<std::size_t>(k)]);
    for (const Seed& seed : task_.seeds) {
      if (seed.slot >= kParameterCount) continue;
      const int at = place_[task_.layout.size + seed.direction].at;
      if (at < from || at >= to) continue;
      p[seed.slot].seed(at - from, seed.derivative);
      effects |= seed.effect;
    }
    ChunkRun<Isa, S> run(task_, std::span<const S>(p, static_cast<std::size_t>(kParameterCount)), effects,
                         bias);
    std::size_t sample = 0;
    Pack8 gradient[packs] = {};
    const FlightState<S> end = run(seeded<S>(from, to), [&](std::size_t i, int channel, const S& residual) {
      const double weight = task_.weight[channel], r = residual.v * weight, a = r < 0 ? -r : r;
      // Huber: beyond the bend the row is scaled so that J'J and J'r are those of rho.
      const double bend = a <= task_.huber ? 1.0 : __builtin_sqrt(task_.huber / a);
      Pack8* row = J_ + sample * static_cast<std::size_t>(packs_) + pack;
      const double scale = weight * bend;
      for (int k = 0; k < packs; ++k) row[k] = doubles(residual, k) * scale;
      if (first) {
        out_.cost += a <= task_.huber ? r * r : task_.huber * (2 * a - task_.huber);
        count(out_, channel, r, task_.huber, 0.0);
      }
      for (int k = 0; k < packs; ++k) gradient[k] += row[k] * (r * bend);
      if (first) {
        sample_[sample] = {scale, r * bend, channel};
        analytic(J_ + sample * static_cast<std::size_t>(packs_), channel, task_.t[i] - task_.t[task_.begin],
                 run.attitude(), scale);
      }
      ++sample;
    });
    samples_ = sample;
    for (int i = from; i < to; ++i)
      if (column_[i].external >= 0)
        out_.g.data()[column_[i].external] = gradient[(i - from) / 8][(i - from) % 8];
    store_end(end, from);
    if (first) out_.x_end = values(end);
  }

  // Eight derivatives in double precision.
  template <class S>
  static Pack8 doubles(const S& x, int pack) {
    if constexpr (S::lanes == 8) {
      return x.d[pack];
    } else {
      using Half = float __attribute__((vector_size(32)));
      Half half;
      __builtin_memcpy(&half,
                       reinterpret_cast<const char*>(&x.d) + static_cast<std::size_t>(pack) * sizeof(Half),
                       sizeof(Half));
      return __builtin_convertvector(half, Pack8);
    }
  }

  template <class S>
  FlightState<S> seeded(int from, int to) const {
    const FlightState<double>& x = task_.x0;
    const StateLayout& layout = task_.layout;
    FlightState<S> s;
    const auto seed = [&](S& scalar, int external, double derivative) {
      const int at = place_[external].at;
      if (at >= from && at < to) scalar.seed(at - from, derivative);
    };
    for (int k = 0; k < 4; ++k) s.body.q_WB[k] = S(x.body.q_WB[k]);
    for (int k = 0; k < 3; ++k) {
      s.body.w_B[k] = S(x.body.w_B[k]), s.body.v_W[k] = S(x.body.v_W[k]), s.body.x_W[k] = S(x.body.x_W[k]);
      seed(s.body.w_B[k], layout.w + k, 1.0);
      if (layout.v >= 0) seed(s.body.v_W[k], layout.v + k, 1.0);
      if (layout.x >= 0) seed(s.body.x_W[k], layout.x + k, 1.0);
      s.outside.w_dot_B[k] = S(x.outside.w_dot_B[k]), s.outside.v_dot_W[k] = S(x.outside.v_dot_W[k]);
      if (layout.w_dot >= 0) seed(s.outside.w_dot_B[k], layout.w_dot + k, 1.0);
      if (layout.v_dot >= 0) seed(s.outside.v_dot_W[k], layout.v_dot + k, 1.0);
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
    for (int i = 0; i < S::width; ++i)
      if (column_[from + i].external >= 0) E[column_[from + i].external] = scalar.derivative(i);
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
      if (layout.w_dot >= 0) put_end(layout.w_dot + k, end.outside.w_dot_B[k], from);
      if (layout.v_dot >= 0) put_end(layout.v_dot + k, end.outside.v_dot_W[k], from);
    }
    if (layout.motors < 0) return;
    for (int i = 0; i < layout.rotors; ++i) {
      put_end(layout.motors + i, end.motors[static_cast<std::size_t>(i)].Omega, from);
      put_end(layout.motors + layout.rotors + i, end.motors[static_cast<std::size_t>(i)].Omega_dot, from);
    }
  }

  template <class S>
  FlightState<double> values(const FlightState<S>& s) const {
    FlightState<double> x = task_.x0;
    for (int k = 0; k < 4; ++k) x.body.q_WB[k] = s.body.q_WB[k].v;
    for (int k = 0; k < 3; ++k) {
      x.body.w_B[k] = s.body.w_B[k].v, x.body.v_W[k] = s.body.v_W[k].v, x.body.x_W[k] = s.body.x_W[k].v;
      x.outside.w_dot_B[k] = s.outside.w_dot_B[k].v, x.outside.v_dot_W[k] = s.outside.v_dot_W[k].v;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(task_.layout.rotors); ++i)
      x.motors[i] = {s.motors[i].Omega.v, s.motors[i].Omega_dot.v};
    return x;
  }

  // A = J'J by blocks of 8 x 8, over tiles of samples that stay in the nearest memory.
  void square() {
    constexpr std::size_t tile = 32;
    const int blocks = packs_ * (packs_ + 1) / 2;
    Pack8* sums = &table<AlignedSum>(static_cast<std::size_t>(8 * blocks))->pack;
    for (int i = 0; i < 8 * blocks; ++i) sums[i] = Pack8{};
    for (std::size_t from = 0; from < samples_; from += tile) {
      const std::size_t to = from + tile < samples_ ? from + tile : samples_;
      Pack8* sum = sums;
      for (int bi = 0; bi < packs_; ++bi) {
        int bk = 0;
        for (; bk + 1 <= bi; bk += 2, sum += 16) add_products<2>(from, to, bi, bk, sum);
        if (bk == bi) add_products<1>(from, to, bi, bk, sum), sum += 8;
      }
    }
    const Pack8* sum = sums;
    for (int bi = 0; bi < packs_; ++bi)
      for (int bk = 0; bk <= bi; ++bk, sum += 8)
        for (int i = 0; i < 8; ++i)
          for (int k = 0; k < 8; ++k) {
            const int r = column_[8 * bi + i].external, c = column_[8 * bk + k].external;
            if (r < 0 || c < 0) continue;
            out_.A.data()[r * d_ + c] = sum[i][k];
            out_.A.data()[c * d_ + r] = sum[i][k];
          }
  }

  // Products of pack bi with the N packs from bk on, summed over samples.
  template <int N>
  void add_products(std::size_t from, std::size_t to, int bi, int bk, Pack8* sum) const {
    const auto stride = static_cast<std::size_t>(packs_);
    Pack8 s[8 * N];
    for (int i = 0; i < 8 * N; ++i) s[i] = sum[i];
    for (std::size_t n = from; n < to; ++n) {
      const Pack8* row = J_ + n * stride;
      const double* left = reinterpret_cast<const double*>(row + bi);
      for (int m = 0; m < N; ++m) {
        const Pack8 right = row[bk + m];
        for (int i = 0; i < 8; ++i) s[8 * m + i] += left[i] * right;
      }
    }
    for (int i = 0; i < 8 * N; ++i) sum[i] = s[i];
  }

  // Leverage of each sample with respect to the local state: j P j'.
  void leverages() {
    const auto stride = static_cast<std::size_t>(packs_);
    const int n = task_.layout.size;
    AlignedCovariance* P = table<AlignedCovariance>(static_cast<std::size_t>(n) * stride);
    for (int a = 0; a < n; ++a) {
      Pack8* row = &P[static_cast<std::size_t>(a) * stride].pack;
      for (std::size_t k = 0; k < stride; ++k) row[k] = Pack8{};
      for (int b = 0; b < n; ++b) row[place_[b].at / 8][place_[b].at % 8] = task_.covariance[a * n + b];
    }
    for (std::size_t s = 0; s < samples_; ++s) {
      const Pack8* j = J_ + s * stride;
      Pack8 sum{};
      for (int a = 0; a < n; ++a) {
        const double ja = j[place_[a].at / 8][place_[a].at % 8];
        if (ja == 0) continue;
        const Pack8* row = &P[static_cast<std::size_t>(a) * stride].pack;
        for (std::size_t k = 0; k < stride; ++k) sum += (ja * row[k]) * j[k];
      }
      double total = 0;
      for (int k = 0; k < 8; ++k) total += sum[k];
      out_.leverage[static_cast<std::size_t>(sample_[s].channel)] += total;
    }
  }

  // Columns that need no dual numbers: where the chunk starts and how fast, a constant push in the world
  // frame, and a bias that adds to the rates as shown.
  template <class S>
  void analytic(Pack8* row, int channel, double t, const Vec4<S>& q, double scale) const {
    for (int k = dual_packs_; k < packs_; ++k) row[k] = Pack8{};
    for (int i = 8 * dual_packs_; i < columns_; ++i) {
      const Column& column = column_[i];
      if (column.external < 0) continue;
      const double slope = slope_of(column, channel, t, q);
      if (slope != 0) row[i / 8][i % 8] = slope * scale;
    }
  }

  template <class S>
  static double slope_of(const Column& column, int channel, double t, const Vec4<S>& q) {
    const bool velocity = channel == kVelocity + column.axis, position = channel == kPosition + column.axis;
    switch (column.kind) {
      case Kind::position:
        return position ? 1.0 : 0.0;
      case Kind::velocity:
        return velocity ? 1.0 : position ? t : 0.0;
      case Kind::push:
        if (velocity || position) return velocity ? t : 0.5 * t * t;
        return channel >= kForce && channel < kForce + 3 ? turned(q, column.axis, channel - kForce) : 0.0;
      case Kind::bias:
        return channel == kGyro + column.axis ? column.derivative : 0.0;
      default:
        return 0.0;
    }
  }

  // Element (row, column) of the rotation from body to world.
  template <class S>
  static double turned(const Vec4<S>& q, int row, int column) {
    const double w = value(q[0]), v[3] = {value(q[1]), value(q[2]), value(q[3])};
    if (row == column) return w * w + 2 * v[row] * v[row] - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const int third = 3 - row - column;
    const double sign = (column - row + 3) % 3 == 1 ? -1.0 : 1.0;
    return 2 * (v[row] * v[column] + sign * w * v[third]);
  }

  // Gradient and end state of the analytic columns.
  void analytic_gradient() {
    const auto stride = static_cast<std::size_t>(packs_);
    const double h = task_.t[task_.end] - task_.t[task_.begin];
    const StateLayout& layout = task_.layout;
    for (int i = 8 * dual_packs_; i < columns_; ++i) {
      const Column& column = column_[i];
      if (column.external < 0) continue;
      double sum = 0;
      for (std::size_t s = 0; s < samples_; ++s)
        sum += J_[s * stride + static_cast<std::size_t>(i / 8)][i % 8] * sample_[s].residual;
      out_.g.data()[column.external] = sum;
      const auto end = [&](int component, double derivative) {
        if (component >= 0) out_.E.data()[(component + column.axis) * d_ + column.external] = derivative;
      };
      if (column.kind == Kind::position) end(layout.x, 1.0);
      if (column.kind == Kind::velocity) end(layout.v, 1.0), end(layout.x, h);
      if (column.kind == Kind::push) end(layout.v_dot, 1.0), end(layout.v, h), end(layout.x, h * h / 2);
    }
  }

  struct Place {
    int at = -1;
  };
  struct Sample {
    double scale = 0, residual = 0;
    int channel = 0;
  };

  // Memory that stays from chunk to chunk; types of this class, so that no other build shares their code.
  template <class T>
  static T* table(std::size_t size) {
    thread_local std::vector<T> memory;
    if (memory.size() < size) memory = std::vector<T>(size + size / 2);
    return memory.data();
  }

  const ChunkTask& task_;
  ChunkResult& out_;
  int d_, columns_ = 0, dual_packs_ = 0, packs_ = 0;
  Place* place_ = nullptr;
  Column* column_ = nullptr;
  Sample* sample_ = nullptr;
  Pack8* J_ = nullptr;
  std::size_t samples_ = 0;
};

}  // namespace ident
