// Numbers, words for "no value", and clock times in cells.
#include "ident/io/csv/cell_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>

#include "ident/core/parse_number.h"
#include "ident/io/csv/thousands.h"

namespace ident {
namespace {

constexpr std::size_t kLongestNumber = 400;  // a double written out in full stays below

bool says_no_value(std::string_view cell) {
  static constexpr std::array<std::string_view, 5> words = {"na", "n/a", "null", "none", "nan"};
  return std::ranges::any_of(words, [&](std::string_view word) {
    return std::ranges::equal(
        cell, word, [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
  });
}

/// Whether a text that was read as zero holds a digit that is not: a number too small for a double.
bool vanished(std::string_view cell) {
  const std::string_view mantissa = cell.substr(0, cell.find_first_of("eE"));
  return mantissa.find_first_of("123456789") != std::string_view::npos;
}

void note(OddCells& odd, const std::string& column, long line) {
  if (odd.count++ > 0) return;
  odd.first_line = line;
  odd.first_column = column;
}

/// Whole number at the start of a text, which then loses it and the character that ends it.
std::optional<long> take_integer(std::string_view& text, std::string_view ends) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (text.empty() || ends.find(text.front()) == std::string_view::npos) return std::nullopt;
  text.remove_prefix(1);
  return value;
}

/// Days since 1970 of a leading `YYYY-MM-DD`, `YYYY/MM/DD`; the text loses it.
std::optional<long> take_date(std::string_view& text) {
  const auto year = take_integer(text, "-/.");
  const auto month = year ? take_integer(text, "-/.") : std::nullopt;
  const auto day = month ? take_integer(text, " T") : std::nullopt;
  if (!day) return std::nullopt;
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(static_cast<int>(*year)),
                            std::chrono::month(static_cast<unsigned>(*month)),
                            std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

}  // namespace

std::optional<double> CellNumbers::parse(std::string_view cell) {
  const bool may_hold_comma = dialect_.separator != ',' && dialect_.decimal != DecimalMark::point;
  const std::size_t comma = may_hold_comma ? cell.find(',') : std::string_view::npos;
  if (comma == std::string_view::npos) {
    if (dialect_.decimal == DecimalMark::comma && cell.find('.') != std::string_view::npos)
      return std::nullopt;
    return parse_number(cell);
  }
  std::array<char, kLongestNumber> with_point;
  if (cell.size() > with_point.size() || cell.find('.') != std::string_view::npos) return std::nullopt;
  std::ranges::copy(cell, with_point.begin());
  with_point[comma] = '.';
  const std::optional<double> value = parse_number({with_point.data(), cell.size()});
  if (value) dialect_.decimal = DecimalMark::comma;
  return value;
}

std::optional<double> CellNumbers::read(std::string_view cell, const std::string& column, long line) {
  if (cell.empty()) return kNaN;
  std::optional<double> value = parse(cell);
  had_thousands_ = false;
  if (!value) {
    const std::string plain = without_thousands(cell, dialect_.decimal);
    if (!plain.empty()) value = parse_number(plain);
    had_thousands_ = value.has_value();
  }
  if (!value && !says_no_value(cell)) return std::nullopt;
  if (!value || std::isnan(*value)) {
    note(nan_, column, line);
    return kNaN;
  }
  if (std::isinf(*value)) {
    note(infinite_, column, line);
    return kNaN;
  }
  if (*value == 0.0 && cell.size() > 1 && vanished(cell)) note(tiny_, column, line);
  return value;
}

std::optional<double> CellNumbers::read_clock(std::string_view cell) {
  std::string_view rest = cell;
  const std::optional<long> date = take_date(rest);
  if (!date) rest = cell;
  const auto hours = take_integer(rest, ":");
  const auto minutes = hours ? take_integer(rest, ":") : std::nullopt;
  if (!minutes) return std::nullopt;
  std::string seconds(rest.substr(0, rest.find('Z')));
  std::ranges::replace(seconds, ':', '.');  // 17:14:08:947
  std::ranges::replace(seconds, ',', '.');
  const std::optional<double> s = parse_number(seconds);
  if (!s || *hours > 23 || *minutes > 59 || !(*s >= 0.0 && *s < 61.0)) return std::nullopt;
  const long day = date.value_or(0);
  if (!first_day_) first_day_ = day;
  return static_cast<double>((day - *first_day_) * 86400 + *hours * 3600 + *minutes * 60) + *s;
}

std::vector<Warning> CellNumbers::warnings(const std::string& file) const {
  std::vector<Warning> list;
  const auto add = [&](const OddCells& odd, const char* code, const char* what) {
    if (odd.count == 0) return;
    list.push_back({code, fmt::format("{}:{}: {}: {} ({} cells in all)", file, odd.first_line,
                                      odd.first_column, what, odd.count)});
  };
  add(nan_, "nan_cells", "no number, taken as not sampled");
  add(infinite_, "infinite_cells", "infinite or too large, taken as not sampled");
  add(tiny_, "tiny_numbers", "too small for a double, taken as 0");
  return list;
}

}  // namespace ident
