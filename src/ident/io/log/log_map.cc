// Reads map files.
#include "ident/io/log/log_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ident/io/file/yaml_value.h"
#include "ident/io/log/mapped_columns.h"

namespace ident {
namespace {

const std::vector<std::string> kMapKeys = {"columns", "frames",  "windows",         "formats",    "airborne",
                                           "outputs", "command", "controller_rate", "not_streams"};
const std::vector<std::string> kFrameKeys = {"body", "world"};
const std::vector<std::string> kAirborneKeys = {"stream", "column", "is", "from", "until", "commands_above"};
const std::vector<std::string> kOutputKeys = {"function", "motors"};
const std::vector<std::string> kCommandKeys = {"min", "max"};

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

std::vector<std::string> words(const YamlValue& value) {
  if (!value.is_list()) return {value.text()};
  std::vector<std::string> list;
  for (const YamlValue& one : value.list()) list.push_back(one.text());
  return list;
}

AirborneRule read_airborne(const YamlValue& value) {
  value.expect_map(kAirborneKeys);
  AirborneRule rule;
  if (value.has("commands_above")) {
    rule.commands_above = value.at("commands_above").number();
    return rule;
  }
  rule.stream = value.at("stream").text();
  rule.column = value.at("column").text();
  if (value.has("is")) {
    rule.is = value.at("is").number();
  } else {
    rule.from = value.at("from").number();
    rule.until = value.at("until").number();
  }
  return rule;
}

/// What only profiles state.
void read_profile_keys(const YamlValue& file, LogMap& map) {
  if (file.has("formats")) map.formats = words(file.at("formats"));
  if (file.has("airborne"))
    for (const YamlValue& rule : file.at("airborne").list()) map.airborne.push_back(read_airborne(rule));
  if (file.has("outputs")) {
    const YamlValue outputs = file.at("outputs");
    outputs.expect_map(kOutputKeys);
    map.output_function = outputs.at("function").text();
    for (const YamlValue& value : outputs.at("motors").list()) map.motor_functions.push_back(value.number());
  }
  if (file.has("not_streams")) map.not_streams = words(file.at("not_streams"));
  if (file.has("controller_rate")) map.controller_rate = words(file.at("controller_rate"));
  if (file.has("command")) {
    const YamlValue command = file.at("command");
    command.expect_map(kCommandKeys);
    map.command = {words(command.at("min")), words(command.at("max"))};
  }
}

LogMap map_of(const YamlValue& file) {
  file.expect_map(kMapKeys);
  LogMap map;
  map.file = file.file();
  if (file.has("columns")) read_mapped_columns(file.at("columns"), map);
  if (file.has("frames")) {
    const YamlValue frames = file.at("frames");
    frames.expect_map(kFrameKeys);
    map.states_body = frames.has("body");
    map.states_world = frames.has("world");
    if (map.states_body) map.body = read_frame(frames.at("body"), &body_frame, body_frame_names());
    if (map.states_world) map.world = read_frame(frames.at("world"), &world_frame, world_frame_names());
  }
  if (file.has("windows")) {
    map.windows_line = file.at("windows").line();
    for (const YamlValue& window : file.at("windows").list()) map.windows.push_back(read_window(window));
  }
  read_profile_keys(file, map);
  return map;
}

}  // namespace

LogMap read_log_map(const std::string& path) { return map_of(load_yaml(path)); }

LogMap parse_log_map(const std::string& text, const std::string& name) {
  return map_of(parse_yaml(text, name));
}

}  // namespace ident
