// The models of the ladder, from the one as stated to the one that was refined in all constants.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"
#include "ident/flight/ladder/window_fit.h"

namespace ident {

/// What a model of the ladder has beyond the one below it.
enum class Rung {
  stated,   ///< nothing
  motors,   ///< rotor speeds for commands, where both were logged
  thrust,   ///< thrust for the speeds or commands flown, against the weight
  drag,     ///< drag of the rotors
  battery,  ///< rotor speed for a command by the voltage
  ground,   ///< thrust by the height above the ground
  air,      ///< what else the air does to rotors and body
  curve,    ///< thrust that is no square of the rotor speed, or speed that is not as stated for a command
  trim,     ///< moments that last: balance, and what the airspeed does to the hubs
  inertia,  ///< moments of inertia and torque of the rotors
  full,     ///< everything that the refinement has
};

/// A rung between the stated and the full model, and what of it these logs can tell.
struct RungModel {
  Rung rung = Rung::stated;
  FitTo what = FitTo::forces;
  std::vector<std::string> constants;  ///< those of lower rungs on the same side are fitted anew with them
};

/// Those of which the logs can tell something, from the lowest up.
std::vector<RungModel> rungs_for(const MeasuredMotion& motion);

}  // namespace ident
