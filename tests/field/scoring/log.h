// A flight log as columns over time, for the scorer.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace field {

// Cells that are empty are NaN.
using Columns = std::map<std::string, std::vector<double>>;
Columns read_csv(const std::string& path);

// A column that was sampled at some rows only: the samples, without repeats of a held value.
struct Series {
  std::vector<double> t, x;
  double held(double time) const;          // the last sample at or before `time`
  double interpolated(double time) const;  // linear between samples
};
Series samples_of(const Columns& log, const std::string& name, bool drop_repeats);

}  // namespace field
