// Runs the motors through the history of commands that every arc carries.
#include "ident/flight/record/motor_start.h"

namespace ident {

std::array<MotorState<double>, kMaxRotors> motors_at_start(Flight<double, EffectSet<double>>& flight,
                                                           double t, std::size_t rotors) {
  constexpr double kBefore = 0.3, kStep = 0.005;  // s: ten lags of usual motors
  const int steps = static_cast<int>(kBefore / kStep + 0.5);
  std::array<MotorState<double>, kMaxRotors> motors{};
  for (std::size_t n = 0; n < rotors; ++n) motors[n] = {flight.steady_speed(n, t - kBefore), 0.0};
  for (int s = 0; s < steps; ++s) flight.advance(motors, t - kBefore + s * kStep, kStep);
  return motors;
}

}  // namespace ident
