// The true vehicle of a case under a controller of one's choice.
#pragma once

#include <functional>
#include <map>

#include "mended_case.h"
#include "tuned_controller.h"

namespace mended {

struct Tracked {
  double t;
  Vector3d aim, p;  // m, north, west, up
};

struct ClosedLoop {
  bool crashed = false;
  double until = 0;                            // s, flown
  double rms = 0;                              // m, of the position against the reference, after settling
  double steepest = 0;                         // rad
  std::map<std::string, double> by_reference;  // m, RMS
  std::vector<Tracked> path;
};

// Flies the references. The same gusts and the same noise whatever the controller.
ClosedLoop fly_references(const Case& truth, const References& references, TunedController controller);

// Largest error, m/s and rad/s, of this vehicle against the flight of the withheld simulator over `seconds`
// under the same commands: both have to be the same vehicle.
double replay_error(const Case& truth, double seconds);

}  // namespace mended
