// Reads the lines of a map, one or one for each rotor.
#include "ident/io/log/mapped_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/nearest_word.h"
#include "ident/core/parse_number.h"
#include "ident/io/log/log_signals.h"

namespace ident {
namespace {

const std::vector<std::string> kColumnKeys = {"column",  "unit", "scale", "offset", "stream", "where", "time",
                                              "late_by", "nan",  "by",    "per",    "range",  "behind"};
const std::vector<std::string> kLateKeys = {"column", "scale"};
const std::vector<std::string> kLowPassKeys = {"lag", "square"};
constexpr const char* kNumber = "{n}";
constexpr std::string_view kOutput = "{output";  // of which `{output}`, `{output-1}` are made

bool is_signal(const std::string& name) {
  return std::ranges::any_of(log_signals(kMostRotors),
                             [&](const LogSignal& s) { return s.signal.name == name; });
}

std::vector<std::string> signal_names() {
  std::vector<std::string> names;
  for (const LogSignal& s : log_signals(4)) names.push_back(s.signal.name);
  return names;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// `{n}` and `{n-1}` in a line of rotor n; other lines have none.
std::string numbered(const std::string& text, int n) {
  if (n == 0) return text;
  return with(with(text, kNumber, std::to_string(n)), "{n-1}", std::to_string(n - 1));
}

void read_conditions(const YamlValue& where, int n, MappedColumn& mapped) {
  where.expect_map();
  for (const std::string& field : where.keys()) {
    std::string text = numbered(where.at(field).text(), n);
    const bool of_output = text.starts_with(kOutput) && text.ends_with('}');
    if (of_output) text = text.substr(kOutput.size(), text.size() - kOutput.size() - 1);
    const std::optional<double> value = text.empty() ? 0.0 : parse_number(text);
    if (!value) where.at(field).fail("has to be a number");
    mapped.where.push_back({field, *value, of_output});
  }
}

MappedLowPass read_low_pass(const YamlValue& value) {
  if (!value.is_map()) return {.cutoff = value.text()};
  value.expect_map(kLowPassKeys);
  return {.lag = value.at("lag").text(), .square = value.at("square").text()};
}

MappedColumn read_column(const YamlValue& value, int n) {
  MappedColumn mapped;
  mapped.line = value.line();
  mapped.number = n;
  if (value.is_null()) return mapped;
  if (value.is_list()) {
    const std::vector<YamlValue> alternatives = value.list();
    if (alternatives.empty()) value.fail("names no column");
    mapped = read_column(alternatives.front(), n);
    for (std::size_t i = 1; i < alternatives.size(); ++i)
      mapped.otherwise.push_back(read_column(alternatives[i], n));
    return mapped;
  }
  if (!value.is_map()) {
    mapped.column = numbered(value.text(), n);
  } else {
    value.expect_map(kColumnKeys);
    mapped.column = numbered(value.at("column").text(), n);
    if (value.has("unit")) mapped.unit = value.at("unit").text();
    if (value.has("scale")) mapped.scale = value.at("scale").number();
    if (value.has("offset")) mapped.offset = value.at("offset").number();
    if (mapped.scale == 0.0) value.at("scale").fail("is zero");
    if (value.has("stream")) mapped.stream = numbered(value.at("stream").text(), n);
    if (value.has("nan")) mapped.nan_is = value.at("nan").number();
    if (value.has("time")) mapped.time = numbered(value.at("time").text(), n);
    if (value.has("behind")) mapped.behind = read_low_pass(value.at("behind"));
    if (value.has("where")) read_conditions(value.at("where"), n, mapped);
    if (value.has("by")) mapped.by = value.at("by").text();
    if (value.has("per")) mapped.per = value.at("per").text();
    if (value.has("range")) {
      const std::vector<YamlValue> ends = value.at("range").list();
      if (ends.size() != 2) value.at("range").fail("has to name two parameters: of 0 and of 1");
      mapped.range = {ends[0].text(), ends[1].text()};
    }
    if (value.has("late_by")) {
      const YamlValue late = value.at("late_by");
      late.expect_map(kLateKeys);
      mapped.late_by = late.at("column").text();
      mapped.late_by_scale = late.at("scale").number();
    }
  }
  if (mapped.column.empty()) value.fail("names no column");
  return mapped;
}

void set_rpm(MappedColumn& mapped) {
  if (mapped.unit.empty()) mapped.unit = "rpm";
  for (MappedColumn& other : mapped.otherwise) set_rpm(other);
}

/// `rpm2` is another spelling of `omega2`, with its unit.
void read_signal(const YamlValue& value, const std::string& name, int n, LogMap& map) {
  const bool is_rpm = name.starts_with("rpm");
  const std::string signal = is_rpm ? "omega" + name.substr(3) : name;
  if (!is_signal(signal)) value.fail("is no signal of a flight log" + did_you_mean(name, signal_names()));
  MappedColumn mapped = read_column(value, n);
  if (is_rpm) set_rpm(mapped);
  if (!map.columns.emplace(signal, mapped).second) value.fail("is given twice: " + signal + " is the same");
}

}  // namespace

void read_mapped_columns(const YamlValue& columns, LogMap& map) {
  columns.expect_map();
  for (const std::string& name : columns.keys()) {
    const YamlValue value = columns.at(name);
    if (name.find(kNumber) == std::string::npos)
      read_signal(value, name, 0, map);
    else
      for (int n = 1; n <= kMostRotors; ++n) read_signal(value, numbered(name, n), n, map);
  }
}

}  // namespace ident
