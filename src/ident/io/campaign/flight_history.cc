// One YAML file with two parameter files in it.
#include "ident/io/campaign/flight_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "ident/io/vehicle/vehicle_yaml.h"

namespace ident {
namespace {

bool same(const Known& a, const Known& b) { return a.value == b.value && a.std == b.std; }

std::string indented(const std::string& text) {
  std::string out = "  ";
  for (const char c : text) {
    out += c;
    if (c == '\n') out += "  ";
  }
  out.resize(out.find_last_not_of(' ') + 1);
  return out;
}

std::string listed(const char* key, const std::vector<InputFile>& files) {
  std::string out = files.empty() ? fmt::format("{}: []\n", key) : fmt::format("{}:\n", key);
  for (const InputFile& file : files)
    out += fmt::format("  - {{file: {}, sha256: {}}}\n", quoted(file.path), quoted(file.sha256));
  return out;
}

std::vector<InputFile> files_of(const YamlValue& list) {
  std::vector<InputFile> files;
  for (const YamlValue& file : list.list())
    files.push_back({file.at("file").text(), file.at("sha256").text()});
  return files;
}

}  // namespace

bool FlightHistory::is_in(const Vehicle& now) const {
  return std::ranges::any_of(after.parameters, [&](const auto& found) {
    const auto& [name, known] = found;
    const bool was_before = before.has(name) && same(before.parameters.at(name), known);
    return !was_before && now.has(name) && same(now.parameters.at(name), known);
  });
}

Vehicle FlightHistory::undone(const Vehicle& now) const {
  std::set<std::string> changed;
  for (const auto& [name, known] : now.parameters)
    if (!after.has(name) || !same(after.parameters.at(name), known)) changed.insert(name);
  Vehicle out = before;
  std::erase_if(out.parameters,
                [&](const auto& known) { return after.has(known.first) && !now.has(known.first); });
  for (const std::string& name : changed) out.parameters[name] = now.parameters.at(name);
  out.correlation =
      out.correlation.part([&](const std::string& name) { return out.has(name); })
          .renewed(now.correlation, [&](const std::string& name) { return changed.contains(name); });
  return out;
}

std::string flight_history_path(const std::string& folder) {
  return (std::filesystem::path(folder) / ".ident" / "flights.yaml").lexically_normal().string();
}

std::optional<FlightHistory> read_flight_history(const std::string& folder) {
  const std::string path = flight_history_path(folder);
  if (!std::filesystem::exists(path)) return std::nullopt;
  const YamlValue file = load_yaml(path);
  return FlightHistory{vehicle_from(file.at("before")), vehicle_from(file.at("after")),
                       files_of(file.at("logs")), files_of(file.at("earlier"))};
}

std::string flight_history_text(const FlightHistory& history) {
  return "# Written by `ident flightlog --refine`, and read by it: a log that comes again is no evidence "
         "twice.\n" +
         listed("logs", history.logs) + listed("earlier", history.earlier) + "before:\n" +
         indented(vehicle_to_yaml(history.before)) + "after:\n" + indented(vehicle_to_yaml(history.after));
}

}  // namespace ident
