// The columns of J of one chunk: those that need dual numbers, and those that follow from the time since its
// start.
#pragma once

#include "ident/core/dual.h"
#include "ident/flight/kernel/kernel.h"

namespace ident {

/// A column. `external` is its place in the order of the caller, state first, then shared unknowns; -1: fills
/// up a pack.
template <class Isa>
struct KernelColumn {
  enum class Kind { dual, position, velocity, push, bias, shown_attitude, shown_velocity, shown_position };
  int external = -1, axis = 0;
  Kind kind = Kind::dual;
  double derivative = 1.0;
};

/// Index of a column of the caller in the kernel.
template <class Isa>
struct KernelPlace {
  int at = -1;
};

/// Lists the columns: those with dual numbers first, in packs of eight. Every state gets one; the caller's
/// arrays hold 64 more than there are unknowns.
template <class Isa>
struct KernelColumns {
  using Column = KernelColumn<Isa>;
  using Kind = typename Column::Kind;

  int columns = 0, packs = 0;  ///< packs of columns with dual numbers

  KernelColumns(const ChunkTask& task, KernelPlace<Isa>* place, Column* column) {
    const StateLayout& layout = task.layout;
    for (int i = 0; i < layout.size + task.thetas; ++i) place[i] = {-1};
    const auto add = [&](const Column& c) {
      place[c.external].at = columns;
      column[columns++] = c;
    };
    const unsigned touches = touched(task);
    for (int i = 0; i < layout.size; ++i)
      if (kind_of(task, touches, i) == Kind::dual) add({i, 0, Kind::dual, 1.0});
    for (const Seed& seed : task.seeds)
      if (seed.slot < kParameterCount &&
          place[layout.size + seed.direction].at < 0)  // once, for several slots
        add({layout.size + seed.direction, 0, Kind::dual, seed.derivative});
    // The last packs of dual numbers are filled up: sweeps are 32 columns wide, or 16 in single precision.
    packs = task.exact ? 4 * ((columns + 31) / 32) : 2 * ((columns + 15) / 16);
    while (columns < 8 * packs) column[columns++] = {-1, 0, Kind::dual, 0.0};
    for (int i = 0; i < layout.size; ++i) {
      const Kind kind = kind_of(task, touches, i);
      if (kind != Kind::dual) add({i, i - first_of(layout, kind), kind, 1.0});
    }
    for (const Seed& seed : task.seeds)
      if (seed.slot >= kParameterCount)
        add({layout.size + seed.direction, seed.slot - kParameterCount, Kind::bias, seed.derivative});
  }

 private:
  static int first_of(const StateLayout& layout, Kind kind) {
    switch (kind) {
      case Kind::position:
        return layout.x;
      case Kind::velocity:
        return layout.v;
      case Kind::push:
        return layout.v_dot;
      default:
        return layout.shown_error[static_cast<int>(kind) - static_cast<int>(Kind::shown_attitude)];
    }
  }

  // Columns that need no dual numbers. The position at the start matters to ground effect only, the velocity
  // to drag and whatever the flow touches. A push along world axes reaches the accelerometer unchanged unless
  // the IMU is turned. A slow error adds to what a sensor shows.
  static Kind kind_of(const ChunkTask& task, unsigned touches, int i) {
    const auto within = [&](int first) { return first >= 0 && i >= first && i < first + 3; };
    const StateLayout& layout = task.layout;
    for (int group = 0; group < kShownGroups; ++group)
      if (within(layout.shown_error[group]))
        return static_cast<Kind>(static_cast<int>(Kind::shown_attitude) + group);
    if ((touches & kTouchHeight) != 0) return Kind::dual;
    if (within(layout.x)) return Kind::position;
    if ((touches & kTouchFlow) != 0) return Kind::dual;
    if (within(layout.v)) return Kind::velocity;
    if (within(layout.v_dot) && task.x0.outside.axes == GustAxes::world && (touches & kTouchImuFrame) == 0)
      return Kind::push;
    return Kind::dual;
  }

  // What the model touches at these constants; linear drag counts as flow.
  static unsigned touched(const ChunkTask& task) {
    using S = Dual<1, Isa, float>;  // of this instruction set
    unsigned touches = EffectSet<S>(std::span<const S>(), task.active).touches();
    for (const int drag : {int{param::Kdx}, int{param::Kdy}, int{param::Kdz}}) {
      if (task.p.data()[drag] != 0) touches |= kTouchFlow;
      for (const Seed& seed : task.seeds)
        if (seed.slot == drag) touches |= kTouchFlow;
    }
    return touches;
  }
};

}  // namespace ident
