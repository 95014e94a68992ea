// The kernel itself, templated on an instruction set tag; included by one .cc per instruction set.
//
// Whatever is compiled here for an instruction set must bear its tag: a function without one would be shared
// with the rest of the program, which must run on any machine (a test looks at the symbols).
#pragma once

#include <cstring>

#include "ident/flight/kernel/kernel_columns.h"
#include "ident/flight/kernel/kernel_rows.h"
#include "ident/flight/kernel/kernel_state.h"
#include "ident/flight/kernel/simulate_chunk.h"

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
    place_ = kernel_table<Isa, Place>(static_cast<std::size_t>(d_));
    column_ = kernel_table<Isa, Column>(static_cast<std::size_t>(d_) + 64);
    const KernelColumns<Isa> list(task_, place_, column_);
    columns_ = list.columns, packs_ = list.packs;
    for (auto& of_kind : analytic_)
      for (int& i : of_kind) i = -1;
    for (int i = 8 * packs_; i < columns_; ++i)
      analytic_[static_cast<int>(column_[i].kind)][column_[i].axis] = i;
  }

  using Rows = KernelRows<Isa>;
  using Row = typename Rows::Row;
  using Vector = typename Rows::Vector;
  static constexpr int lanes = Rows::lanes;

  void with_jacobian() {
    const std::size_t most = (task_.end - task_.begin + 64) * kChannels;
    Rows rows(task_, {place_, column_, columns_, packs_}, most);
    out_.cost = 0;
    out_.square = out_.leverage = out_.count = {};
    const std::size_t n = static_cast<std::size_t>(task_.layout.size), d = static_cast<std::size_t>(d_);
    resize(out_.A, d * d), resize(out_.g, d), resize(out_.E, n * d);
    for (double& x : out_.A) x = 0;
    for (double& x : out_.g) x = 0;
    for (double& x : out_.E) x = 0;
    int pack = 0;
    bool first = true;
    while (pack < packs_) {
      const int left = packs_ - pack;
      // Three kinds only: each is a whole copy of the model in the program.
      if (task_.exact)
        sweep<Dual<4, Isa, double>>(pack, first, rows), pack += 4;
      else if (left >= 4)
        sweep<Dual<2, Isa, float>>(pack, first, rows), pack += 4;
      else
        sweep<Dual<1, Isa, float>>(pack, first, rows), pack += 2;
      first = false;
    }
    analytic_end();
    if (task_.products) rows.square(out_);
    if (task_.covariance) rows.leverages(out_);
  }

  static void resize(std::vector<double>& v, std::size_t n) {
    if (v.size() != n) v = std::vector<double>(n);
  }

  template <class S>
  void sweep(int pack, bool first, Rows& rows) {
    constexpr int vectors = S::width / lanes;
    const int from = 8 * pack, to = from + S::width;
    EffectMask effects = task_.active;  // active effects, and those of the directions of this sweep
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
    rows.count = 0;
    Vector gradient[vectors] = {};
    const KernelState<Isa> state(task_, place_, column_);
    const FlightState<S> end =
        run(state.template seeded<S>(from, to), [&](std::size_t i, int channel, const S& residual) {
          const double weight = task_.weight[channel], r = residual.v * weight, a = r < 0 ? -r : r;
          // Huber: beyond the bend the row is scaled so that J'J and J'r are those of rho.
          const double bend = a <= task_.huber ? 1.0 : __builtin_sqrt(task_.huber / a);
          Vector* row = rows.slopes(rows.count) + from / lanes;
          const double scale = weight * bend, share = r * bend;
#pragma GCC unroll 16
          for (int k = 0; k < vectors; ++k) {
            row[k] = doubles(residual, k) * scale;
            gradient[k] += row[k] * share;
          }
          if (first) {
            out_.cost += a <= task_.huber ? r * r : task_.huber * (2 * a - task_.huber);
            count_residual<Isa>(out_, channel, r, task_.huber);
            Row& others = rows.row(rows.count);
            others.channel = channel;
            analytic(others, task_.t[i] - task_.t[task_.begin], run.attitude(), scale, share);
          }
          ++rows.count;
        });
    for (int i = from; i < to; ++i)
      if (column_[i].external >= 0)
        out_.g.data()[column_[i].external] = gradient[(i - from) / lanes][(i - from) % lanes];
    state.store_end(end, from, out_.E.data());
    if (first) out_.x_end = state.values(end);
  }

  // A vector of derivatives in double precision.
  template <class S>
  [[gnu::always_inline]] static Vector doubles(const S& x, int k) {
    if constexpr (S::lanes == lanes) {
      return x.d[k];
    } else {
      using Half = typename VectorOf<float, Isa::kBytes / 2>::type;
      Half half;
      __builtin_memcpy(&half,
                       reinterpret_cast<const char*>(&x.d) + static_cast<std::size_t>(k) * sizeof(Half),
                       sizeof(Half));
      return __builtin_convertvector(half, Vector);
    }
  }

  // Columns without dual numbers: position and velocity at the start, a constant push along world axes, a
  // gyro bias, and slow errors. `residual`: of this sample, scaled like its row.
  template <class S>
  void analytic(Row& row, double t, const Vec4<S>& q, double scale, double residual) {
    const int channel = row.channel, axis = channel % 3;
    row.others = 0;
    const auto put = [&](Kind kind, int of, double slope) {
      const int i = analytic_[static_cast<int>(kind)][of];
      if (i < 0) return;
      const double x = slope * column_[i].derivative * scale;
      row.column[row.others] = i, row.slope[row.others++] = x;
      out_.g.data()[column_[i].external] += x * residual;
    };
    switch (channel - axis) {
      case kGyro:
        put(Kind::bias, axis, 1.0);
        break;
      case kForce:
        for (int k = 0; k < 3; ++k) put(Kind::push, k, turned(q, k, axis));
        break;
      case kAttitude:
        put(Kind::shown_attitude, axis, 1.0);
        break;
      case kVelocity:
        put(Kind::velocity, axis, 1.0), put(Kind::push, axis, t), put(Kind::shown_velocity, axis, 1.0);
        break;
      case kPosition:
        put(Kind::position, axis, 1.0), put(Kind::velocity, axis, t), put(Kind::push, axis, 0.5 * t * t);
        put(Kind::shown_position, axis, 1.0);
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

  // Derivative of the end state over the columns without dual numbers.
  void analytic_end() {
    const double h = task_.t[task_.end] - task_.t[task_.begin];
    const StateLayout& layout = task_.layout;
    for (int i = 8 * packs_; i < columns_; ++i) {
      const Column& column = column_[i];
      const auto end = [&](int component, double derivative) {
        if (component >= 0) out_.E.data()[(component + column.axis) * d_ + column.external] = derivative;
      };
      if (column.kind == Kind::position) end(layout.x, 1.0);
      if (column.kind == Kind::velocity) end(layout.v, 1.0), end(layout.x, h);
      if (column.kind == Kind::push) end(layout.v_dot, 1.0), end(layout.v, h), end(layout.x, h * h / 2);
      if (column.kind >= Kind::shown_attitude)
        end(layout.shown_error[static_cast<int>(column.kind) - static_cast<int>(Kind::shown_attitude)], 1.0);
    }
  }

  const ChunkTask& task_;
  ChunkResult& out_;
  int d_, columns_ = 0, packs_ = 0;
  Place* place_ = nullptr;
  Column* column_ = nullptr;
  int analytic_[8][3];  ///< columns without dual numbers by kind and axis; -1: none
};

}  // namespace ident
