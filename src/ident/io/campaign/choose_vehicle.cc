// Counts the vehicles that lie there, and drafts one where there is none.
#include "ident/io/campaign/choose_vehicle.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "ident/core/error.h"
#include "ident/io/draft/draft_vehicle.h"
#include "ident/io/file/yaml_value.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/log_formats/read_log_streams.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> of_kind(const std::vector<FoundFile>& files, FileKind kind) {
  std::vector<std::string> paths;
  for (const FoundFile& file : files)
    if (file.kind == kind) paths.push_back(file.path);
  return paths;
}

void expect_readable_simulators(std::vector<FoundFile>& files) {
  for (FoundFile& file : files) {
    if (file.kind != FileKind::simulator) continue;
    try {
      read_vehicle(file.path);
    } catch (const Error& error) {
      file = {file.path, FileKind::other, without_name(error.what(), file.path)};
    }
  }
}

void refuse_several(const std::vector<std::string>& vehicles) {
  if (vehicles.size() < 2) return;
  throw UsageError(
      fmt::format("{} vehicles lie there, and a campaign has one: {}; name it with --vehicle FILE",
                  vehicles.size(), fmt::join(vehicles, ", ")));
}

/// Logs of flights that state where the motors sit. What is no flight is told of when flights are read.
std::vector<LogStreams> logs_with_geometry(const std::vector<FoundFile>& files,
                                           std::vector<std::string>& notices) {
  std::vector<LogStreams> logs;
  for (const std::string& path : of_kind(files, FileKind::autopilot_log)) {
    try {
      LogStreams log = read_log_streams(path);
      draft_vehicle(std::span(&log, 1));
      read_flight_log(path, Vehicle{}, {});
      logs.push_back(std::move(log));
    } catch (const DataError& error) {
      notices.emplace_back(error.what());
    } catch (const Error&) {
    }
  }
  return logs;
}

std::string blank_vehicle(const std::string& folder) {
  const auto line = [](const char* key, const char* comment) {
    return fmt::format("{:<34} # {}\n", key, comment);
  };
  return "# No file of this campaign states its vehicle. FILL IN the lines that are commented out.\n" +
         fmt::format("name: {}\n", quoted(fs::weakly_canonical(folder).filename().string())) +
         line("# mass: {value: 0.5, std: 0.005}", "FILL IN: kg, as it flies, and how well it is known") +
         line("# layout: x", "FILL IN: plus, x or 4sp; other vehicles list their `rotors`") +
         line("# arm: 0.17", "FILL IN: m, from the centre to a hub") +
         line("# command: {min: 1100, max: 1940}",
              "us, the pulse widths of command 0 and 1; for files with pulse widths");
}

ChosenVehicle draft_in(const std::string& folder, const std::vector<FoundFile>& files) {
  ChosenVehicle chosen{.file = (fs::path(folder) / "vehicle.yaml").lexically_normal().string()};
  if (fs::exists(chosen.file))
    throw InputError(
        chosen.file, 0, "",
        "is there already and states no rotors that can be read (`ident check` says why): nothing is "
        "overwritten; --vehicle takes it as it is");
  const std::vector<LogStreams> logs = logs_with_geometry(files, chosen.notices);
  if (logs.empty()) {
    chosen.drafted = blank_vehicle(folder);
  } else {
    VehicleDraft draft = draft_vehicle(logs);
    chosen.drafted = std::move(draft.yaml), chosen.fill_in = std::move(draft.fill_in);
    chosen.notices.clear();  // of logs that state no geometry, where another one does
    for (std::string& other : draft.notices) chosen.warnings.push_back({"other_frame", std::move(other)});
  }
  chosen.vehicle = vehicle_from(parse_yaml(chosen.drafted, chosen.file));
  return chosen;
}

}  // namespace

ChosenVehicle choose_vehicle(const std::string& folder, std::vector<FoundFile>& files,
                             const std::string& named) {
  if (!named.empty()) return {.file = named, .vehicle = read_vehicle(named)};
  expect_readable_simulators(files);
  for (const FileKind kind : {FileKind::vehicle, FileKind::simulator}) {
    const std::vector<std::string> there = of_kind(files, kind);
    refuse_several(there);
    if (there.size() == 1) return {.file = there.front(), .vehicle = read_vehicle(there.front())};
  }
  return draft_in(folder, files);
}

}  // namespace ident
