// Whether what a model leaves over is as steady as gusts are, or comes and goes.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/statistics/residual_wrench.h"

namespace ident {

/// A channel of one log whose residual has other tails than a normal process.
struct Unsteady {
  std::string channel;
  int log = 0;
  double kurtosis = 3.0;
  double deviations = 0;    ///< of its logarithm from that of a normal process, in standard deviations
  double from = 0, to = 0;  ///< s: the stretch of some seconds with most of it
  double share = 0;         ///< of the power, that lies in that stretch
};

/// Light turbulence is a stationary normal process (Dryden): a residual that is next to nothing for seconds
/// and large for one is none. The channel of each log that departs most, the furthest first. About the yaw
/// axis gusts jump too, as rotors do not share their drag alike: Mz is left out.
std::vector<Unsteady> unsteady(const ResidualWrench& wrench);

}  // namespace ident
