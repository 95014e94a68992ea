// Predicts a flight from stated constants: velocity after 0.5 s, rates after 0.1 s, from measured states.
#pragma once

#include <vector>

#include "log.h"
#include "model.h"

namespace field {

// Squared errors, one a window, in order of time.
struct PredictionErrors {
  std::vector<double> velocity;  // (m/s)^2, after 0.5 s, attitude and rates as measured
  std::vector<double> rates;     // (rad/s)^2, after 0.1 s, velocity as measured
};
inline constexpr double kWindowStep = 0.1;  // s between the starts of windows

enum class RotorInput { kSpeeds, kCommands };

bool has_speeds(const Columns& log);
PredictionErrors predict(const StatedModel& model, const Columns& log, RotorInput input);

}  // namespace field
