// The causal test across channels: a true cause has one size in all that a flight shows.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/hypotheses/fitted_model.h"

namespace ident {

/// What one part of what a flight shows asks of the size of a cause found, all else being refitted with it.
struct Asked {
  std::string part;     ///< "roll", "height", "rotor speeds" or "motors (not measured)"
  double change = 0.0;  ///< by what share of itself the size would change if the part had its way
  double std = 0.0;     ///< of that, by its scatter over blocks of flight
  double weight = 0.0;  ///< share of what is known of the size
};

/// A part whose weight is less has no say in a cause's size.
inline constexpr double kHasASay = 0.01;

/// For each adopted cause what each part asks.
std::vector<std::vector<Asked>> asked_by_channels(const FittedModel& model);

}  // namespace ident
