// What a model says along measured flight: the velocity and the rates that its forces and moments give.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"

namespace ident {

/// The rotors along an arc, from the commands or measured.
struct MotorsAlong {
  using Motors = std::array<MotorState<double>, kMaxRotors>;
  std::vector<Motors> at;  ///< [row looked at]
  std::vector<Motors>
      between;  ///< [row looked at] up to the next: speeds of the mean thrust, mean derivatives
};

/// Along one arc; attitude, rates, velocity and position are those measured.
struct ModelAlong {
  std::vector<Vec3<double>> gained_W;  ///< [row looked at] integral of the specific force in the world, m/s
  std::vector<Vec3<double>> turned_B;  ///< [row looked at] integral of the angular acceleration, rad/s
  std::shared_ptr<const MotorsAlong> motors;
};

/// One for each arc of the motion. `p`: the model's constants.
std::vector<ModelAlong> model_along(const MeasuredMotion& motion, std::span<const double> p);

/// The same with constants that differ from those of `near` in the one at `moved` only: rotors that turn as
/// they did there are not simulated again.
std::vector<ModelAlong> model_along(const MeasuredMotion& motion, std::span<const double> p,
                                    const std::vector<ModelAlong>& near, int moved);

}  // namespace ident
