// When columns of a log were sampled anew, and how rough commands are from one sample to the next.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ident/data/flight_log.h"

namespace ident {

/// Rows from one change of a column to the next above which the column is held in between.
inline constexpr double kHeldRows = 1.5;

/// Rows of a log that bring something new of a group of columns, and the median time between them, s (NaN of
/// fewer than two): the rows where it was sampled; of columns that hold in between, the rows where most of
/// them change, if these come at even times.
struct NewSamples {
  std::vector<std::size_t> rows;
  double apart = 0.0;
};
NewSamples new_samples(const std::vector<double>& t, std::span<const std::vector<double>> columns);

/// By how much commands change from one to the next, of what they change over 25 of them: 1 for noise, 0 for
/// what is smooth.
double roughness(const FlightLog& log);

}  // namespace ident
