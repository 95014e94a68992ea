// Holds constants that a flight near hover cannot determine at their priors.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/flight/smoother/parameterisation.h"
#include "ident/result/result.h"

namespace ident {

/// Whether the self-test found little more than hover.
bool is_hover(std::span<const Warning> findings);

/// Which constants of motors and inertia are held in hover.
enum class Held {
  all,       ///< all: free ones would be fitted to the noise of one initial transient
  unstated,  ///< only those without a prior: stated ones may be off within their deviation, which is no gap
};

/// Holds them. Returns the names of all that hover does not determine.
std::vector<std::string> hold_for_hover(std::vector<FreeConstant>& constants, Held which = Held::all);

/// Gives the held constants the values and deviations that `constants` had before: nothing comes from flight.
void as_before_flight(std::vector<Parameter>& parameters, const std::vector<FreeConstant>& constants,
                      std::span<const std::string> held);

}  // namespace ident
