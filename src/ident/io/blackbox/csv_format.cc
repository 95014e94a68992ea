// Reads blackbox logs that were turned into CSV, by blackbox_decode or by the Blackbox Explorer.
#include "ident/io/blackbox/csv_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/blackbox/settings.h"

namespace ident {

namespace {

constexpr std::string_view first_column = "loopIteration";

/// The next line of a text, without its end; the text is shortened.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// The next cell of a line, without blanks and quotes; the line is shortened.
std::string_view take_cell(std::string_view& line) {
  while (line.starts_with(' ')) line.remove_prefix(1);
  std::string_view cell;
  if (line.starts_with('"')) {
    const std::size_t end = std::min(line.find('"', 1), line.size());
    cell = line.substr(1, end - 1);
    line.remove_prefix(std::min(end + 1, line.size()));
    line.remove_prefix(std::min(line.find(','), line.size()));
  } else {
    cell = line.substr(0, line.find(','));
    line.remove_prefix(cell.size());
  }
  if (line.starts_with(',')) line.remove_prefix(1);
  while (cell.ends_with(' ')) cell.remove_suffix(1);
  return cell;
}

bool begins_columns(std::string_view line) { return take_cell(line).starts_with(first_column); }

/// The number of a cell; NaN of an empty one or of a word that means none.
std::optional<double> number(std::string_view cell) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty() || cell == "NaN" || cell == "nan" || cell == "X") return none;
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

struct Column {
  std::string name;
  std::vector<double> values;
  bool is_text = false;
};

std::vector<Column> columns_of(std::string_view line) {
  std::vector<Column> columns;
  while (!line.empty()) columns.push_back({.name = std::string(take_cell(line))});
  return columns;
}

/// `V` of `vbatLatest (V)`.
std::string unit_of(const std::string& name) {
  const std::size_t open = name.find(" (");
  return open == std::string::npos || !name.ends_with(')') ? std::string{}
                                                           : name.substr(open + 2, name.size() - open - 3);
}

/// Seconds in a step of the time column. The Explorer writes microseconds without saying so.
double seconds_of_time_unit(const std::string& unit, const std::string& file) {
  if (unit == "us" || unit.empty()) return 1e-6;
  if (unit == "ms") return 1e-3;
  if (unit == "s") return 1.0;
  throw InputError(file, 1, "time", fmt::format("has the unit {}, not us, ms or s", unit));
}

void read_rows(std::string_view text, long line_number, std::vector<Column>& columns, LogStreams& streams) {
  for (; !text.empty(); ++line_number) {
    std::string_view line = take_line(text);
    if (line.empty()) continue;
    std::size_t i = 0;
    const std::string_view whole = line;
    for (; i < columns.size() && !line.empty(); ++i) {
      Column& column = columns[i];
      const std::string_view cell = take_cell(line);
      if (column.is_text) continue;
      const std::optional<double> value = number(cell);
      if (value) {
        column.values.push_back(*value);
      } else {
        column.is_text = true;
        column.values = {};
      }
    }
    if (i == columns.size()) continue;
    // The last line of a file that was cut off: as if it were not there.
    for (std::size_t k = 0; k < i; ++k)
      if (!columns[k].is_text) columns[k].values.pop_back();
    streams.damage.push_back(
        fmt::format("row {}: {} of {} cells: {}", line_number, i, columns.size(), whole.substr(0, 20)));
    if (!text.empty())
      throw InputError(streams.file, line_number, "",
                       fmt::format("has {} cells, {} are named", i, columns.size()));
  }
}

}  // namespace

bool BlackboxCsvFormat::recognises(std::string_view first) {
  return begins_columns(first.substr(0, 100)) || first.starts_with("\"Product\",\"Blackbox");
}

LogStreams BlackboxCsvFormat::read(std::string_view bytes, const std::string& file) {
  LogStreams streams{.file = file, .format = "blackbox_csv"};
  blackbox::Header header;
  std::string_view line = take_line(bytes);
  while (!begins_columns(line)) {
    if (bytes.empty())
      throw InputError(file, 0, "", "has no line of column names that begins with loopIteration");
    const std::string name(take_cell(line));
    header.lines.emplace_back(name, std::string(take_cell(line)));
    line = take_line(bytes);
  }
  blackbox::add_settings(header, 1, streams);
  std::vector<Column> columns = columns_of(line);
  if (columns.size() < 2 || !columns[1].name.starts_with("time"))
    throw InputError(file, 1, "time", "is missing behind loopIteration");
  const double step = seconds_of_time_unit(unit_of(columns[1].name), file);
  read_rows(bytes, static_cast<long>(header.lines.size()) + 2, columns, streams);
  const std::vector<double>& times = columns[1].values;
  const auto first = std::find_if(times.begin(), times.end(), [](double t) { return !std::isnan(t); });
  if (columns[1].is_text || first == times.end()) throw InputError(file, 2, "time", "holds no times");
  LogStream main{.name = "1:main", .clock = columns[1].name};
  double last = 0.0;
  for (const double time : times)  // a frame whose time is unknown has that of the one before
    main.t.push_back(last = std::isnan(time) ? last : step * (time - *first));
  for (Column& column : columns)
    if (!column.is_text)
      main.fields.push_back(
          {.name = column.name, .unit = unit_of(column.name), .values = std::move(column.values)});
  streams.streams.push_back(std::move(main));
  return streams;
}

}  // namespace ident
