// The kernel itself, templated on an instruction set tag; included by one .cc per instruction set.
//
// Whatever is compiled here for an instruction set must bear its tag: a function without one would be shared
// with the rest of the program, which must run on any machine (a test looks at the symbols).
#pragma once

#include <cstring>

#include "ident/estimators/flight_chunk_run.h"
#include "ident/estimators/flight_kernel_columns.h"
#include "ident/estimators/flight_kernel_products.h"
#include "ident/estimators/flight_kernel_state.h"

namespace ident {

template <class Isa>
class ChunkKernel {
 public:
  static void evaluate(const ChunkTask& task, ChunkResult& out) { ChunkKernel(task, out).with_jacobian(); }

 private:
  ChunkKernel(const ChunkTask& task, ChunkResult& out)
      : task_(task), out_(out), d_(task.layout.size + task.thetas) {
    list_columns();
  }

  using Column = KernelColumn<Isa>;
  using Kind = typename Column::Kind;
  using Place = KernelPlace<Isa>;

  void list_columns() {
    place_ = table<Place>(static_cast<std::size_t>(d_));
    column_ = table<Column>(static_cast<std::size_t>(d_) + 64);
    const KernelColumns<Isa> list(task_, place_, column_);
    columns_ = list.columns, dual_packs_ = list.dual_packs, packs_ = list.packs;
    for (auto& of_kind : analytic_)
      for (int& i : of_kind) i = -1;
    for (int i = 8 * dual_packs_; i < columns_; ++i)
      if (column_[i].external >= 0) analytic_[static_cast<int>(column_[i].kind)][column_[i].axis] = i;
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
    analytic_end();
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
    const KernelState<Isa> state(task_, place_, column_);
    const FlightState<S> end =
        run(state.template seeded<S>(from, to), [&](std::size_t i, int channel, const S& residual) {
          const double weight = task_.weight[channel], r = residual.v * weight, a = r < 0 ? -r : r;
          // Huber: beyond the bend the row is scaled so that J'J and J'r are those of rho.
          const double bend = a <= task_.huber ? 1.0 : __builtin_sqrt(task_.huber / a);
          Pack8* row = J_ + sample * static_cast<std::size_t>(packs_) + pack;
          const double scale = weight * bend;
          for (int k = 0; k < packs; ++k) row[k] = doubles(residual, k) * scale;
          if (first) {
            out_.cost += a <= task_.huber ? r * r : task_.huber * (2 * a - task_.huber);
            count_residual<Isa>(out_, channel, r, task_.huber);
          }
          for (int k = 0; k < packs; ++k) gradient[k] += row[k] * (r * bend);
          if (first) {
            sample_[sample] = {channel};
            analytic(J_ + sample * static_cast<std::size_t>(packs_), channel,
                     task_.t[i] - task_.t[task_.begin], run.attitude(), scale, r * bend);
          }
          ++sample;
        });
    samples_ = sample;
    for (int i = from; i < to; ++i)
      if (column_[i].external >= 0)
        out_.g.data()[column_[i].external] = gradient[(i - from) / 8][(i - from) % 8];
    state.store_end(end, from, out_.E.data());
    if (first) out_.x_end = state.values(end);
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

  // A = J'J.
  void square() {
    Pack8* sums = &table<AlignedSum>(static_cast<std::size_t>(8 * PackProducts<Isa>::blocks(packs_)))->pack;
    PackProducts<Isa>(J_, samples_, packs_).square(sums);
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

  // Leverage of each sample with respect to the local state: j P j'. Where a channel has many, every
  // third may stand for its neighbours.
  void leverages() {
    constexpr int kEvery = 3, kMany = 30;
    int seen[kChannels] = {}, taken[kChannels] = {};
    double sum_of[kChannels] = {};
    const auto stride = static_cast<std::size_t>(packs_);
    const int n = task_.layout.size;
    AlignedCovariance* P = table<AlignedCovariance>(static_cast<std::size_t>(n) * stride);
    for (int a = 0; a < n; ++a) {
      Pack8* row = &P[static_cast<std::size_t>(a) * stride].pack;
      for (std::size_t k = 0; k < stride; ++k) row[k] = Pack8{};
      for (int b = 0; b < n; ++b) row[place_[b].at / 8][place_[b].at % 8] = task_.covariance[a * n + b];
    }
    for (std::size_t s = 0; s < samples_; ++s) {
      const int c = sample_[s].channel;
      if (task_.few_leverages && out_.count.data()[c] >= kMany && seen[c]++ % kEvery != kEvery / 2) continue;
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
      sum_of[c] += total, taken[c] += 1;
    }
    for (int c = 0; c < kChannels; ++c)
      if (taken[c] > 0) out_.leverage.data()[c] += sum_of[c] * (out_.count.data()[c] / taken[c]);
  }

  // Columns that need no dual numbers: where the chunk starts and how fast, a constant push in the world
  // frame, and a bias that adds to the rates as shown. `residual`: of this sample, scaled like its row.
  template <class S>
  void analytic(Pack8* row, int channel, double t, const Vec4<S>& q, double scale, double residual) {
    for (int k = dual_packs_; k < packs_; ++k) row[k] = Pack8{};
    const int axis = channel % 3;
    const auto put = [&](Kind kind, int of, double slope) {
      const int i = analytic_[static_cast<int>(kind)][of];
      if (i < 0) return;
      const double x = slope * column_[i].derivative * scale;
      row[i / 8][i % 8] = x;
      out_.g.data()[column_[i].external] += x * residual;
    };
    switch (channel - axis) {
      case kGyro:
        put(Kind::bias, axis, 1.0);
        break;
      case kForce:
        for (int k = 0; k < 3; ++k) put(Kind::push, k, turned(q, k, axis));
        break;
      case kVelocity:
        put(Kind::velocity, axis, 1.0), put(Kind::push, axis, t);
        break;
      case kPosition:
        put(Kind::position, axis, 1.0), put(Kind::velocity, axis, t), put(Kind::push, axis, 0.5 * t * t);
        break;
      default:
        break;
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

  // End state of the analytic columns.
  void analytic_end() {
    const double h = task_.t[task_.end] - task_.t[task_.begin];
    const StateLayout& layout = task_.layout;
    for (int i = 8 * dual_packs_; i < columns_; ++i) {
      const Column& column = column_[i];
      if (column.external < 0) continue;
      const auto end = [&](int component, double derivative) {
        if (component >= 0) out_.E.data()[(component + column.axis) * d_ + column.external] = derivative;
      };
      if (column.kind == Kind::position) end(layout.x, 1.0);
      if (column.kind == Kind::velocity) end(layout.v, 1.0), end(layout.x, h);
      if (column.kind == Kind::push) end(layout.v_dot, 1.0), end(layout.v, h), end(layout.x, h * h / 2);
    }
  }

  struct Sample {
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
  int analytic_[5][3];  ///< columns without dual numbers by kind and axis; -1: none
  Sample* sample_ = nullptr;
  Pack8* J_ = nullptr;
  std::size_t samples_ = 0;
};

}  // namespace ident
