// Orders rows by time.
#include "ident/io/log/log_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/io/csv/table_checks.h"

namespace ident {
namespace {

using Rows = std::vector<double>;

/// Cells of rows with the same time stamp, as logs of mixed rates have them, put into the first of these
/// rows.
void merge_repeated(NumberTable& table, const std::vector<std::size_t>& keep,
                    std::vector<std::size_t>& rows) {
  const Rows t = *table.find("t");
  for (const std::size_t i : keep) {
    if (rows.empty() || t[i] != t[rows.back()]) {
      rows.push_back(i);
      continue;
    }
    for (Column& column : table.columns) {
      double& first = column.values[rows.back()];
      if (std::isnan(first)) first = column.values[i];
    }
  }
}

}  // namespace

std::vector<double> put_time_in_order(NumberTable& table) {
  const TimeOrder order = time_order(table.file, *table.find("t"), table.line);
  for (const Warning& warning : time_warnings(table.file, order)) table.warnings.push_back(warning);
  std::vector<std::size_t> rows;
  merge_repeated(table, order.keep, rows);
  if (rows.size() < table.rows()) keep_rows(table, rows);
  return order.breaks;
}

double count_from_begin(NumberTable& table, std::vector<double>& breaks) {
  constexpr double kLong = 1e5;  // s, of which a double tells some picoseconds
  std::vector<double>& t = std::ranges::find(table.columns, std::string("t"), &Column::name)->values;
  const double first = t.empty() || !(std::abs(t.front()) > kLong) ? 0.0 : std::floor(t.front());
  if (first == 0) return first;
  for (double& one : t) one -= first;
  for (double& one : breaks) one -= first;
  table.notices.push_back(fmt::format("{}: times count from {:.0f} s of the log", table.file, first));
  return first;
}

}  // namespace ident
