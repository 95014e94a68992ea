// What a flight that hardly leaves hover cannot tell is held at what was known.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/flight/smoother/parameterisation.h"
#include "ident/result/result.h"

namespace ident {

/// Whether a self-test found little more than hover.
bool is_hover(std::span<const Warning> findings);

/// Of which constants of motors and inertia hover is not trusted to tell anything.
enum class Held {
  all,       ///< free, they would be fitted to the noise of one initial transient
  unstated,  ///< only those: what is stated may be off by its deviation, and is no gap then
};

/// Holds them; gives the names of all that hover is not trusted with.
std::vector<std::string> hold_for_hover(std::vector<FreeConstant>& constants, Held which = Held::all);

/// Says of the constants held what `constants`, as they were before, say of them: nothing comes from flight.
void as_before_flight(std::vector<Parameter>& parameters, const std::vector<FreeConstant>& constants,
                      std::span<const std::string> held);

}  // namespace ident
