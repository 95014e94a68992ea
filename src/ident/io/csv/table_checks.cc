// Checks of a table, each with a message that says what to do.
#include "ident/io/csv/table_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/io/csv/match_header.h"

namespace ident {
namespace {

constexpr double kBackwardAllowed = 0.2;  // share of rows

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::string alternatives_text(const std::vector<std::vector<std::string>>& alternatives) {
  std::vector<std::string> words;
  for (const auto& columns : alternatives) words.push_back(fmt::format("{}", fmt::join(columns, " and ")));
  return fmt::format("{}", fmt::join(words, " or "));
}

std::string suggestion(const std::vector<std::string>& header, const std::string& name) {
  std::vector<std::string> keys;
  for (const std::string& h : header) keys.push_back(header_key(h));
  const std::string near = nearest_word(name, keys);
  const auto at = std::ranges::find(keys, near);
  if (near.empty()) return "";
  return fmt::format(" (is it '{}'?)", header[static_cast<std::size_t>(at - keys.begin())]);
}

bool is_empty(const Column& column) {
  return std::ranges::all_of(column.values, [](double v) { return std::isnan(v); });
}

/// The magnitude that 9 of 10 samples keep below.
double usual_magnitude(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double v : values)
    if (!std::isnan(v)) sizes.push_back(std::abs(v));
  if (sizes.empty()) return 0.0;
  const auto at = sizes.begin() + static_cast<long>(sizes.size() * 9 / 10);
  std::ranges::nth_element(sizes, at);
  return *at;
}

}  // namespace

void expect_columns(const std::string& path, long line, const std::vector<std::string>& header,
                    const std::vector<std::string>& found, const TableSchema& schema) {
  for (const auto& alternatives : schema.required) {
    const bool there = std::ranges::any_of(alternatives, [&](const std::vector<std::string>& columns) {
      return std::ranges::all_of(columns, [&](const std::string& name) { return holds(found, name); });
    });
    if (there) continue;
    const std::string& name = alternatives.front().front();
    throw InputError(path, line, alternatives_text(alternatives),
                     fmt::format("the column is missing{}; a {} needs it, and the file has: {}",
                                 suggestion(header, name), schema.kind, column_list(header)));
  }
}

void drop_empty_columns(NumberTable& table, const TableSchema& schema) {
  std::vector<std::string> usable;
  for (const Column& column : table.columns)
    if (!is_empty(column)) usable.push_back(column.name);
  for (const TextColumn& column : table.text) usable.push_back(column.name);
  for (const auto& alternatives : schema.required) {
    const bool there = std::ranges::any_of(alternatives, [&](const std::vector<std::string>& columns) {
      return std::ranges::all_of(columns, [&](const std::string& name) { return holds(usable, name); });
    });
    if (!there)
      throw DataError(fmt::format("{}: {}: the column holds no usable value", table.file,
                                  alternatives_text(alternatives)));
  }
  std::erase_if(table.columns, [&](const Column& column) {
    const bool empty = is_empty(column);
    if (empty)
      table.warnings.push_back(
          {"empty_column", fmt::format("{}: {}: the column is empty throughout", table.file, column.header)});
    return empty;
  });
}

void expect_plausible(const NumberTable& table, const TableSchema& schema, long header_line) {
  for (const Signal& signal : schema.signals) {
    if (signal.largest == 0.0) continue;
    const auto column = std::ranges::find(table.columns, signal.name, &Column::name);
    if (column == table.columns.end()) continue;
    const auto too_large = [&](double value) { return std::abs(value) > signal.largest; };
    if (std::ranges::none_of(column->values, too_large)) continue;
    const double usual = usual_magnitude(column->values);
    if (usual > signal.largest)
      throw InputError(
          table.file, header_line, column->header,
          fmt::format("values like {:.4g} are too large for {} in SI units: name the unit in the header, "
                      "as in '{} [unit]' (known: {})",
                      usual, signal.name, signal.name, known_units(signal.dimension)));
  }
}

TimeOrder time_order(const std::string& path, const std::vector<double>& t, const std::vector<long>& line) {
  TimeOrder order;
  double last = -std::numeric_limits<double>::infinity();
  constexpr int kSetBack = 5;          // rows; fewer came late
  constexpr double kSetBackBy = 0.25;  // s; two rows that come late come less late
  int late = 0;
  double back = 0;
  const auto set_back = [&] { return late >= kSetBack || (late > 1 && back > kSetBackBy); };
  const auto count = [](long& number, long& first, long where) {
    if (number++ == 0) first = where;
  };
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (std::isnan(t[i])) {
      count(order.missing, order.first_missing, line[i]);
    } else if (t[i] < last || (t[i] == last && set_back())) {
      count(order.backward, order.first_backward, line[i]);
      ++late, back = std::max(back, last - t[i]);
    } else {
      if (set_back()) order.breaks.push_back(last);
      late = 0, back = 0;
      if (t[i] == last) count(order.repeated, order.first_repeated, line[i]);
      order.keep.push_back(i);
      last = t[i];
    }
  }
  if (static_cast<double>(order.backward) > kBackwardAllowed * static_cast<double>(t.size()))
    throw InputError(path, order.first_backward, "t",
                     fmt::format("time runs backward in {} of {} rows: rows out of order, or a wrong column",
                                 order.backward, t.size()));
  return order;
}

std::vector<Warning> time_warnings(const std::string& path, const TimeOrder& order) {
  std::vector<Warning> list;
  const auto add = [&](long count, long line, const char* code, const char* what) {
    if (count > 0)
      list.push_back({code, fmt::format("{}:{}: t: {} ({} rows in all)", path, line, what, count)});
  };
  add(order.backward, order.first_backward, "time_backward", "time goes back; such rows were dropped");
  add(order.repeated, order.first_repeated, "time_repeated", "the time stamp is that of the row before");
  add(order.missing, order.first_missing, "time_missing", "no time; such rows were dropped");
  return list;
}

void keep_rows(NumberTable& table, const std::vector<std::size_t>& keep) {
  const auto pick = [&](auto& values) {
    auto kept = values;
    kept.clear();
    for (const std::size_t i : keep) kept.push_back(values[i]);
    values = std::move(kept);
  };
  for (Column& column : table.columns) pick(column.values);
  for (TextColumn& column : table.text) pick(column.values);
  pick(table.line);
}

}  // namespace ident
