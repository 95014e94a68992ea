// Bursts: moments at which an acceleration from outside jumps as no steady gusts do.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/fit/fit.h"

namespace ident {

/// Jumps of one channel in one log.
struct Burst {
  std::string channel;  ///< Mx My Mz about the body's axes, Fx Fy Fz along the world's
  int log = 0, count = 0;
  int plain = 0;       ///< of these, such as no error of measured speeds makes
  double largest = 0;  ///< jump in standard deviations of the steady ones
  double t = 0;        ///< of the largest, s
};

/// Channels with two jumps or more that neither the steady part of the same log nor the sensors account for,
/// the worst first: a burst has an onset and an end.
std::vector<Burst> bursts(const FlightRecord& record, const FlightFit& fit);

}  // namespace ident
