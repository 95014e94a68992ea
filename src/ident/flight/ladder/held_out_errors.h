// Errors of prediction as a user feels them: m/s, rad/s and degrees after 0.1, 0.5 and 1 s of held-out
// flight.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"

namespace ident {

/// What is predicted, and from what.
enum class Metric {
  velocity,       ///< m/s, with attitude and rates as measured
  rate,           ///< rad/s, with velocity as measured
  attitude,       ///< rad, with velocity as measured
  open_velocity,  ///< m/s, everything predicted
  open_attitude,  ///< rad, everything predicted
  rotor_speed,    ///< rad/s, by the commands: mean square over the rotors
  count
};
inline constexpr std::size_t kMetrics = static_cast<std::size_t>(Metric::count);
inline constexpr std::array kLadderHorizons{0.1, 0.5, 1.0};  // s

/// A window of held-out flight: size of each error; NaN where it was not logged or the arc ends before.
struct WindowErrors {
  std::size_t arc = 0;
  double t = 0.0;  ///< start, s
  std::array<std::array<double, kLadderHorizons.size()>, kMetrics> of{};
};

/// Errors of the model with constants `p` over windows that begin every half second.
std::vector<WindowErrors> held_out_errors(const MeasuredMotion& held_out, std::span<const double> p);

/// The same of no model: velocity, rates and attitude (turning on with the rates) stay what they were.
std::vector<WindowErrors> errors_of_persistence(const MeasuredMotion& held_out);

/// Root mean square over windows; NaN without any.
double error_of(const std::vector<WindowErrors>& windows, Metric metric, std::size_t horizon);

}  // namespace ident
