// The swings of a pendulum file: what hung, how, and how long one oscillation took.
#pragma once

#include <string>
#include <vector>

#include "ident/data/table.h"

namespace ident {

/// Which axis of the body stood upright; `platform` is the empty platform.
enum class PendulumAxis { x, y, z, platform };

struct PendulumRow {
  std::string file;
  long line = 0;
  PendulumAxis axis = PendulumAxis::platform;
  double period = 0.0;     ///< s
  double mass = 0.0;       ///< all that hangs, kg
  double radius = 0.0;     ///< of a wire from the axis, m
  double length = 0.0;     ///< of a wire, m
  double offset = 0.0;     ///< of the vehicle's centre of gravity from the axis, m
  double amplitude = 0.0;  ///< rad; 0 where none is given
  double std = 0.0;        ///< of the period, s; 0: not stated
  double swings = 1.0;     ///< oscillations that were timed together; the period's error shrinks with them
};

/// The rows of pendulum tables, sorted by axis. Throws InputError with the line of a value that cannot be.
std::vector<PendulumRow> pendulum_rows(const std::vector<NumberTable>& tables);

}  // namespace ident
