// Reads map files.
#include "ident/io/log/log_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/core/nearest_word.h"
#include "ident/io/file/yaml_value.h"
#include "ident/io/log/log_signals.h"

namespace ident {
namespace {

const std::vector<std::string> kMapKeys = {"columns", "frames", "windows"};
const std::vector<std::string> kColumnKeys = {"column", "unit", "scale", "offset"};
const std::vector<std::string> kFrameKeys = {"body", "world"};

bool is_signal(const std::string& name) {
  return std::ranges::any_of(log_signals(kMostRotors),
                             [&](const LogSignal& s) { return s.signal.name == name; });
}

std::vector<std::string> signal_names() {
  std::vector<std::string> names;
  for (const LogSignal& s : log_signals(4)) names.push_back(s.signal.name);
  return names;
}

MappedColumn read_column(const YamlValue& value) {
  MappedColumn mapped;
  mapped.line = value.line();
  if (value.is_null()) return mapped;
  if (!value.is_map()) {
    mapped.column = value.text();
  } else {
    value.expect_map(kColumnKeys);
    mapped.column = value.at("column").text();
    if (value.has("unit")) mapped.unit = value.at("unit").text();
    if (value.has("scale")) mapped.scale = value.at("scale").number();
    if (value.has("offset")) mapped.offset = value.at("offset").number();
    if (mapped.scale == 0.0) value.at("scale").fail("is zero");
  }
  if (mapped.column.empty()) value.fail("names no column");
  return mapped;
}

/// `rpm2` is another spelling of `omega2`, with its unit.
void read_signal(const YamlValue& value, const std::string& name, LogMap& map) {
  const bool is_rpm = name.starts_with("rpm");
  const std::string signal = is_rpm ? "omega" + name.substr(3) : name;
  if (!is_signal(signal)) value.fail("is no signal of a flight log" + did_you_mean(name, signal_names()));
  MappedColumn mapped = read_column(value);
  if (is_rpm && mapped.unit.empty()) mapped.unit = "rpm";
  if (!map.columns.emplace(signal, mapped).second) value.fail("is given twice: " + signal + " is the same");
}

template <class Frame>
Frame read_frame(const YamlValue& value, std::optional<Frame> (*find)(const std::string&),
                 const std::vector<std::string>& names) {
  const std::string name = value.text();
  if (const auto frame = find(name)) return *frame;
  value.fail(fmt::format("'{}' is no frame that is known: {}", name, fmt::join(names, ", ")));
}

std::array<double, 2> read_window(const YamlValue& value) {
  const std::vector<YamlValue> ends = value.list();
  if (ends.size() != 2) value.fail("has to be [from, to] in seconds");
  const std::array<double, 2> window = {ends[0].number(), ends[1].number()};
  if (window[1] <= window[0]) value.fail("ends before it begins");
  return window;
}

}  // namespace

LogMap read_log_map(const std::string& path) {
  const YamlValue file = load_yaml(path);
  file.expect_map(kMapKeys);
  LogMap map;
  map.file = path;
  if (file.has("columns")) {
    const YamlValue columns = file.at("columns");
    columns.expect_map();
    for (const std::string& name : columns.keys()) read_signal(columns.at(name), name, map);
  }
  if (file.has("frames")) {
    const YamlValue frames = file.at("frames");
    frames.expect_map(kFrameKeys);
    if (frames.has("body")) map.body = read_frame(frames.at("body"), &body_frame, body_frame_names());
    if (frames.has("world")) map.world = read_frame(frames.at("world"), &world_frame, world_frame_names());
  }
  if (file.has("windows")) {
    map.windows_line = file.at("windows").line();
    for (const YamlValue& window : file.at("windows").list()) map.windows.push_back(read_window(window));
  }
  return map;
}

}  // namespace ident
