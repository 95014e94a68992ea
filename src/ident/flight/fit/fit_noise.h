// Noise levels: those to start from, those by the residuals, and the length of chunks that they ask for.
#pragma once

#include "ident/flight/fit/fit.h"

namespace ident {

/// Noise levels to start from: white noise from differences, a generous process noise.
NoiseModel initial_noise(const FlightRecord& record);

/// Chooses the axes of gusts, world or body, by likelihood; those of the world where the flight does not
/// tell. The smoother has world axes and roughly the right noise. Returns whether the choice is beyond doubt,
/// or does not matter.
bool choose_axes(FlightSmoother& smoother, const Eigen::VectorXd& u);

/// Length of chunks that is short enough for that noise, s; `fine`: see FlightFitOptions.
double chunk_for(const FlightRecord& record, const NoiseModel& noise, bool fine = true);

/// Re-estimates the noise levels from the last linearisation, which must have leverages: `rounds` steps for
/// the process noise, one for the sensors. Returns the largest relative change of a standard deviation.
double update_noise(FlightSmoother& smoother, int rounds);

}  // namespace ident
