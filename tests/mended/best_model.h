// The best model that a target can hold, found by least squares on true states.
#pragma once

#include "prediction.h"

namespace mended {

struct Fit {
  TargetModel model;
  double pooled = 0;  // on the flights that it was fitted to
  int parameters = 0, rounds = 0;
};

// Every entry of the target is free: thrust and moment (of each rotor where the file has them), axes, lag,
// inertia, centre of gravity, drag. The mass stays, since only ratios to it act; so do places of hubs. The
// model remains one of a body: its inertia is that of masses, and no drag pushes. `start` has to be such a
// model. Whether some distribution of masses has this inertia.
bool is_body(const TargetModel& model);

Fit fit_best(const TargetModel& start, const std::vector<TrueFlight>& flights, const Horizon& horizon,
             const Errors& unit);

}  // namespace mended
