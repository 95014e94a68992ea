// The battery's voltage in flight without the noise of its sensor.
#pragma once

#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// The battery's voltage at every row of a log with commands, V: what changes slowly, and what the load
/// takes, which goes with the cubes of the commands and shows between samples too. Noise would pass for sag
/// that the motors do not feel, and what a flight tells of battery_sag.n come out too small. As it was
/// logged, with NaN where it was not sampled: without commands, of few samples, and where there is no noise
/// and a sample at about every row, or no load to be seen.
std::vector<double> quiet_voltage(const FlightLog& log);

}  // namespace ident
