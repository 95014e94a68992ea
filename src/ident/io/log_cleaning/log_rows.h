// Rows of a sensor of a flight log: which hold a value, and which repeat another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ident {

inline constexpr std::size_t kFewRows = 20;  // too few to judge

/// Of what is not NaN; none where there is nothing.
inline std::optional<double> middle_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

inline bool sampled(std::span<const std::vector<double>> sensor, std::size_t row) {
  return std::ranges::any_of(sensor, [&](const std::vector<double>& c) { return !std::isnan(c[row]); });
}

inline bool same(std::span<const std::vector<double>> sensor, std::size_t a, std::size_t b) {
  return std::ranges::all_of(sensor, [&](const std::vector<double>& c) {
    return c[a] == c[b] || (std::isnan(c[a]) && std::isnan(c[b]));
  });
}

/// Rows in which a sensor holds a value.
inline std::vector<std::size_t> rows_of(std::span<const std::vector<double>> sensor) {
  std::vector<std::size_t> rows;
  if (sensor.front().empty()) return rows;
  for (std::size_t i = 0; i < sensor.front().size(); ++i)
    if (sampled(sensor, i)) rows.push_back(i);
  return rows;
}

/// Length of a vector in a row.
inline double norm(std::span<const std::vector<double>> sensor, std::size_t row) {
  double sum = 0.0;
  for (const std::vector<double>& c : sensor) sum += c[row] * c[row];
  return std::sqrt(sum);
}

inline void clear_all(std::span<std::vector<double>> sensor) {
  for (std::vector<double>& c : sensor) c.clear();
}

}  // namespace ident
