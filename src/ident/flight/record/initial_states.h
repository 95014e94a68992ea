// Noise levels and states that a record starts from, read off the measurements.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// The column with gaps interpolated linearly; empty when nothing was sampled.
std::vector<double> interpolated(const std::vector<double>& t, const std::vector<double>& column);

/// The same for a channel of an arc.
std::vector<double> filled_column(const FlightArc& arc, int channel);

/// Sets the white noise of every channel from differences of its samples, and the motor states of all rows
/// from a simulation with the constants `p`.
void set_noise_and_motor_start(FlightRecord& record, std::span<const double> p);

/// Sets the rest of those states from the measurements; needs the noise.
void set_body_start(FlightRecord& record);

}  // namespace ident
