// Checks and sorts the rows of pendulum tables.
#include "ident/bench/inertia/trifilar_inertia_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ident/core/error.h"
#include "ident/core/math.h"

namespace ident {
namespace {

std::optional<PendulumAxis> axis_named(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name == "x") return PendulumAxis::x;
  if (name == "y") return PendulumAxis::y;
  if (name == "z") return PendulumAxis::z;
  if (name == "platform") return PendulumAxis::platform;
  return std::nullopt;
}

class RowReader {
 public:
  RowReader(const NumberTable& table, std::size_t row) : table_(table), row_(row) {}

  double number(const std::string& column, double missing) const {
    const std::vector<double>* values = table_.find(column);
    return values && std::isfinite((*values)[row_]) ? (*values)[row_] : missing;
  }

  double positive(const std::string& column) const {
    const double v = number(column, kNaN);
    if (!std::isfinite(v)) refuse(column, "is empty, a row needs it");
    if (!(v > 0.0)) refuse(column, fmt::format("is {}, must be positive", v));
    return v;
  }

  double not_negative(const std::string& column) const {
    const double v = number(column, 0.0);
    if (v < 0.0) refuse(column, fmt::format("is {}, must not be negative", v));
    return v;
  }

  [[noreturn]] void refuse(const std::string& column, const std::string& what) const {
    throw InputError(table_.file, table_.line[row_], column, what);
  }

  PendulumRow read() const {
    PendulumRow row{.file = table_.file, .line = table_.line[row_]};
    const std::string name = table_.find_text("axis") ? (*table_.find_text("axis"))[row_] : "";
    const auto axis = axis_named(name);
    if (!axis) refuse("axis", "'" + name + "' is none of x, y, z, platform");
    row.axis = *axis;
    if (std::isfinite(number("period", kNaN))) {
      row.period = positive("period");
    } else {
      row.swings = positive("oscillations");
      row.period = positive("time") / row.swings;
    }
    row.mass = positive("mass");
    row.radius = positive("radius");
    row.length = positive("length");
    row.offset = std::fabs(number("offset", 0.0));
    row.amplitude = not_negative("amplitude");
    row.std = not_negative("std");
    if (row.amplitude > 2.0)
      refuse("amplitude", fmt::format("{} rad is more than a pendulum swings", row.amplitude));
    if (2.0 * row.radius * std::sin(0.5 * row.amplitude) >= row.length)
      refuse("length", "is too short for the radius and the amplitude");
    return row;
  }

 private:
  const NumberTable& table_;
  std::size_t row_;
};

}  // namespace

std::vector<PendulumRow> pendulum_rows(const std::vector<NumberTable>& tables) {
  std::vector<PendulumRow> rows;
  for (const NumberTable& table : tables)
    for (std::size_t i = 0; i < table.rows(); ++i) rows.push_back(RowReader(table, i).read());
  std::ranges::stable_sort(rows, {}, &PendulumRow::axis);
  return rows;
}

}  // namespace ident
