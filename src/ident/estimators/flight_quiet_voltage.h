// The battery's voltage in flight without the noise of its sensor.
#pragma once

#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// The battery's voltage at every row of a log with commands, V: what changes slowly, and what the load
/// takes, which goes with the cubes of the commands. Noise would pass for sag that the motors do not feel,
/// and what a flight tells of battery_sag.n come out too small. As logged, NaN where it was not sampled,
/// where its noise is no matter beside what it changes by from one sample to the next, or where there are too
/// few.
std::vector<double> quiet_voltage(const FlightLog& log);

}  // namespace ident
