// What a record starts from: noise levels and states read off the measurements.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

/// The column with gaps interpolated linearly; empty when nothing was sampled.
std::vector<double> interpolated(const std::vector<double>& t, const std::vector<double>& column);

/// A channel of an arc, likewise.
std::vector<double> filled_column(const FlightArc& arc, int channel);

/// White noise of every channel from differences of its samples, and states of all rows, their motors
/// simulated with the constants `p`.
void set_noise_and_motor_start(FlightRecord& record, std::span<const double> p);

/// The rest of those states, as measured; asks for the noise.
void set_body_start(FlightRecord& record);

}  // namespace ident
