// What of the windows of a log lies clear of the ground.
#include "ident/data/flight_log.h"

#include <algorithm>

namespace ident {
namespace {

constexpr double kLiftOff = 1.0;  // s after takeoff, in which the ground may push
// s before a landing is told: a landing detector waits for 0.9 s (PX4, MulticopterLandDetector) or 1 s
// (ArduPilot, LAND_DETECTOR_TRIGGER_SEC) of quiet, and a second before that the ground may push.
constexpr double kLanded = 2.0;
constexpr double kMostOfIt = 0.25;  // share of a window that either end takes at most
constexpr double kAtTheEnd = 0.5;   // s: a window that reaches so close to an end of the log has none there

}  // namespace

std::vector<std::array<double, 2>> windows_off_ground(const FlightLog& log) {
  std::vector<std::array<double, 2>> windows = log.windows;
  if (!log.windows_found || log.t.empty()) return windows;
  for (auto& [from, until] : windows) {
    const double most = kMostOfIt * (until - from);
    const bool took_off = from > log.t.front() + kAtTheEnd, landed = until < log.t.back() - kAtTheEnd;
    if (took_off) from += std::min(kLiftOff, most);
    if (landed) until -= std::min(kLanded, most);
  }
  return windows;
}

}  // namespace ident
