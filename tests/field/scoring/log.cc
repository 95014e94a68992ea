// Reads a CSV.
#include "log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace field {

Columns read_csv(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> names;
  std::stringstream heads(line);
  for (std::string name; std::getline(heads, name, ',');) names.push_back(name);
  Columns log;
  std::vector<std::vector<double>*> columns;
  for (const auto& name : names) columns.push_back(&log[name]);
  while (std::getline(in, line)) {
    const char* at = line.c_str();
    for (auto* column : columns) {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      column->push_back(end == at ? std::numeric_limits<double>::quiet_NaN() : value);
      at = *end == ',' ? end + 1 : end;
    }
  }
  return log;
}

Series samples_of(const Columns& log, const std::string& name, bool drop_repeats) {
  const auto &t = log.at("t"), &x = log.at(name);
  Series s;
  for (size_t i = 0; i < t.size(); ++i) {
    if (std::isnan(x[i]) || (drop_repeats && !s.x.empty() && x[i] == s.x.back())) continue;
    s.t.push_back(t[i]);
    s.x.push_back(x[i]);
  }
  return s;
}

double Series::held(double time) const {
  const auto after = std::upper_bound(t.begin(), t.end(), time + 1e-9);
  return after == t.begin() ? x.front() : x[static_cast<size_t>(after - t.begin()) - 1];
}

double Series::interpolated(double time) const {
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return x.front();
  if (after == t.end()) return x.back();
  const auto i = static_cast<size_t>(after - t.begin());
  const double share = (time - t[i - 1]) / (t[i] - t[i - 1]);
  return x[i - 1] + share * (x[i] - x[i - 1]);
}

}  // namespace field
