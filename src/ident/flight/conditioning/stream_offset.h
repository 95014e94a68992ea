// How much later one side of the same motion is than another.
#pragma once

#include <vector>

#include "ident/flight/conditioning/windowed_changes.h"

namespace ident {

/// How much later than another stream of the same log one stream shows the same motion.
struct StreamOffset {
  double seconds = 0.0, std = kNaN;  ///< NaN: the log cannot tell

  /// Beyond doubt, at least so short, s, and enough to matter at this interval between rows.
  bool matters(double interval, double shortest) const;
};

/// Running values of an arc whose changes should agree.
struct StreamSides {
  std::vector<Track> seen, told;  ///< axes
};

/// How much later the told side is than the seen one, by changes over `lag` s. Where no shift of 60 ms makes
/// them agree, as of GPS, up to `farthest` s later of the seen side.
StreamOffset offset_of(const std::vector<StreamSides>& arcs, double interval, double lag,
                       double farthest = 0.0);

}  // namespace ident
