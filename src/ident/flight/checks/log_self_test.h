// What a log says about its own frames, signs and motor order, and about its worth, before anything is
// fitted: a wrong axis makes every estimate wrong, so it is named first.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ident/flight/record/flight_record.h"
#include "ident/result/result.h"

namespace ident {

/// Named findings: wrong_frame, sign_flipped, axes_swapped, motor_order, rotor_spin, thrust_weight (none of
/// the numbers can be trusted); hover_only, no_excitation, saturated_commands, coarse_commands, short_log,
/// low_rate, seldom_commands, seldom_speeds (some cannot be told). Raised on strong evidence only; a log with
/// nothing wrong has none of the first six. `p` are the constants to start from.
std::vector<Warning> self_test(const FlightRecord& record, std::span<const FlightLog> logs,
                               const Vehicle& vehicle, std::span<const double> p);

/// The first finding that makes every estimate worthless, as a verdict; empty without one.
std::string disqualified(const std::vector<Warning>& warnings);

/// Marks every parameter as not identified because of that finding, which becomes the verdict.
void distrust(Result& result, const std::string& wrong);

/// The parts of the test: which axes of the sensors contradict each other, and which contradict the rotors.
struct SensorFrames {
  std::vector<Warning> findings;
  bool rates_confirmed = false;  ///< the attitude turns as the rates say, about all three axes
};

/// How well the rotors as mounted explain the rates: correlation about each axis, and number of windows; and
/// how much thrust varies from window to window, relative to its mean.
struct RotorAgreement {
  std::vector<Warning> findings;
  std::array<double, 3> correlation{};
  double windows = 0, thrust_variation = 0;
};
/// What `rates_confirmed` rules out: rates about axes that run backwards.
using RotorTest = std::function<RotorAgreement(bool rates_confirmed)>;

}  // namespace ident
