// Sensors whose noise was filtered before it was logged: neighbouring samples share it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ident/data/flight_log.h"
#include "ident/result/result.h"

namespace ident {

/// The logs with so many samples of rates and of specific force left that their noise is about white, each
/// with a warning `filtered_noise`: noise below a filter's cut-off says nothing new in samples faster than
/// twice that, and would be counted as if it did. Of a log without attitude, which does not tell how late a
/// filter made each sensor, about as few are left of the one as of the other: more would decide between two
/// that are late differently. Empty where nothing has to be left out.
std::vector<FlightLog> whitened_sensors(std::span<const FlightLog> logs, std::vector<Warning>& warnings);

/// One in so many samples of a sensor has noise that is about white; 1 where no noise is to be seen.
std::size_t white_stride(const std::vector<double>& t, const std::array<std::vector<double>, 3>& sensor);

/// Correlation of the fourth differences of samples `stride` apart with the next, by their signs, over all
/// components: -0.8 of white noise, towards 1 of what is smooth. NaN where there are too few.
double roughness(const std::vector<double>& t, const std::array<std::vector<double>, 3>& sensor,
                 std::size_t stride);

}  // namespace ident
