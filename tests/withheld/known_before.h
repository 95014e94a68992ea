// What the vehicle file states: the base parameters as a bench would have found them, and how well.
#pragma once

#include <map>
#include <string>

#include "members.h"

namespace withheld {

struct Stated {
  double value, std;
};
using KnownBefore = std::map<std::string, Stated>;  // by base parameter

// Truth disturbed by the stated standard deviations.
KnownBefore draw_known_before(const Vehicle& vehicle, Random& random);

// A parameter that is wrong by far more than it says: `size` as in Member.
void make_wrong(const Vehicle& vehicle, const Member& member, double size, KnownBefore* known);

// vehicle.yaml, without any effect parameter.
std::string vehicle_yaml(const Vehicle& vehicle, const KnownBefore& known, const std::string& name);

}  // namespace withheld
