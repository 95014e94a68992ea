// Compares the streams of a log with what an independent decoder read from it: number, first, last, sum.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "ident/data/log_streams.h"
#include "ident/result/result.h"

namespace ident {

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Cells that differ. Numbers agree to 1e-9: sums of decimals are rounded on either side.
inline long digest_differences(const LogStream& stream, const nlohmann::json& digest) {
  const auto same = [](const nlohmann::json& expected, double value) {
    if (expected.is_null()) return !std::isfinite(value);
    const double e = expected.get<double>();
    return std::abs(value - e) <= 1e-9 * std::max(1.0, std::abs(e));
  };
  long differences = 0;
  for (const auto& [name, cells] : digest.items()) {
    const StreamField* field = stream.find(name);
    if (!field || field->size() == 0) {
      ADD_FAILURE() << stream.name << " has no field " << name;
      ++differences;
      continue;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < field->size(); ++i)
      if (std::isfinite(field->at(i))) sum += field->at(i);
    const double n = static_cast<double>(field->size());
    const double first = field->at(0);
    const double last = field->at(field->size() - 1);
    for (const auto& [cell, value] : {std::pair{"n", n}, {"first", first}, {"last", last}, {"sum", sum}})
      if (!same(cells.at(cell), value)) {
        ADD_FAILURE() << stream.name << " " << name << " " << cell << ": " << value << ", expected "
                      << cells.at(cell);
        ++differences;
      }
  }
  return differences;
}

}  // namespace ident
