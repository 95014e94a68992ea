// Sorts files by what they are, and keeps those that read.
#include "ident/io/campaign/lay_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "ident/core/error.h"
#include "ident/io/campaign/campaign_write.h"
#include "ident/io/campaign/choose_vehicle.h"
#include "ident/io/csv/table_schemas.h"
#include "ident/io/file/sha256.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

class Layout {
 public:
  Layout(const std::string& folder, std::vector<FoundFile> files, ChosenVehicle chosen)
      : folder_(folder), files_(std::move(files)), chosen_(std::move(chosen)) {
    assumed_ = chosen_.vehicle;
    if (!assumed_.command) assumed_.command = CommandRange{};
  }

  LaidOutCampaign run() {
    out_.campaign.file = in_folder("ident.yaml");
    out_.campaign.vehicle = chosen_.file;
    out_.campaign.parameters = in_folder("parameters.yaml");
    leave_copies();
    for (const FoundFile& file : files_) sort_in(file);
    leave_idle_maps();
    expect_something();
    out_.text = campaign_text(out_.campaign, folder_);
    out_.drafted = chosen_.drafted;
    out_.notices = chosen_.notices, out_.warnings = chosen_.warnings;
    list_what_to_fill_in();
    list_commands();
    return std::move(out_);
  }

 private:
  std::string in_folder(const char* name) const {
    return (fs::path(folder_) / name).lexically_normal().string();
  }

  void leave(const FoundFile& file, const std::string& why) {
    out_.left.push_back({file.path, FileKind::other, why});
  }

  /// A flight or sweep that is given twice would count twice.
  void leave_copies() {
    std::map<std::uintmax_t, std::vector<std::string>> by_size;
    std::erase_if(files_, [&](const FoundFile& file) {
      if (file.kind > FileKind::table) return false;
      std::vector<std::string>& same_size = by_size[fs::file_size(file.path)];
      const auto twin = std::ranges::find_if(same_size, [&](const std::string& other) {
        return sha256_of_file(other) == sha256_of_file(file.path);
      });
      const bool is_copy = twin != same_size.end();
      if (is_copy)
        leave(file, fmt::format("holds the same bytes as {}", seen_from(folder_, *twin)));
      else
        same_size.push_back(file.path);
      return is_copy;
    });
  }

  void sort_in(const FoundFile& file) {
    switch (file.kind) {
      case FileKind::thrust:
        return take_bench(file, thrust_schema(), out_.campaign.thrust);
      case FileKind::motor:
        return take_bench(file, motor_schema(), out_.campaign.motor);
      case FileKind::inertia:
        return take_bench(file, pendulum_schema(), out_.campaign.inertia);
      case FileKind::flight_log:
      case FileKind::autopilot_log:
        return take_log(file);
      case FileKind::table:
        return take_by_map(file, file.what);
      case FileKind::map:
        return;  // taken with the log that needs it
      case FileKind::vehicle:
      case FileKind::simulator:
        return take_vehicle(file);
      case FileKind::parameters:
        return take_parameters(file);
      case FileKind::other:
        return leave(file, file.what);
    }
  }

  void take_bench(const FoundFile& file, const TableSchema& schema, std::vector<std::string>& list) {
    try {
      const NumberTable table = read_table(file.path, schema);
      bench_pulses_ |= !chosen_.vehicle.command && table.find("u") && !table.find("delta");
    } catch (const Error& error) {
      return leave(file, without_name(error.what(), file.path));
    }
    list.push_back(file.path);
    out_.taken.push_back(file);
  }

  /// What keeps a log from being read, empty where nothing does. Without a range of commands in the vehicle
  /// file any will do, and is to be filled in.
  std::string unreadable(const std::string& path, const std::optional<LogMap>& map) {
    const auto why = [&](const Vehicle& vehicle) -> std::string {
      try {
        read_flight_log(path, vehicle, map);
        return "";
      } catch (const Error& error) {
        return without_name(error.what(), path);
      }
    };
    const std::string as_stated = why(chosen_.vehicle);
    if (as_stated.empty() || chosen_.vehicle.command || !why(assumed_).empty()) return as_stated;
    log_pulses_ = true;
    return "";
  }

  void take_log(const FoundFile& file) {
    const std::string why = unreadable(file.path, {});
    if (!why.empty()) return take_by_map(file, why);
    out_.campaign.logs.push_back({file.path, ""});
    out_.taken.push_back(file);
  }

  /// A log that does not read as it is, `why` not, may do by one of the maps that lie there.
  void take_by_map(const FoundFile& file, const std::string& why) {
    std::vector<std::string> fitting;
    for (const FoundFile& map : files_)
      if (map.kind == FileKind::map && unreadable(file.path, read_log_map(map.path)).empty())
        fitting.push_back(map.path);
    if (fitting.empty()) return leave(file, why);
    if (fitting.size() > 1)
      return leave(
          file, fmt::format("a flight log by either map, {} and {}: name it with one of them in ident.yaml",
                            seen_from(folder_, fitting[0]), seen_from(folder_, fitting[1])));
    out_.campaign.logs.push_back({file.path, fitting.front()});
    const std::string kind = file.kind == FileKind::table ? "flight log" : file.what;
    out_.taken.push_back({file.path, FileKind::flight_log,
                          fmt::format("{}, by the map {}", kind, seen_from(folder_, fitting.front()))});
  }

  void leave_idle_maps() {
    for (const FoundFile& file : files_) {
      if (file.kind != FileKind::map) continue;
      const bool used = std::ranges::any_of(out_.campaign.logs,
                                            [&](const CampaignLog& log) { return log.map == file.path; });
      if (used)
        out_.taken.push_back(file);
      else
        leave(file, "a map that no log here needs: name it beside a log in ident.yaml where one does");
    }
  }

  void take_vehicle(const FoundFile& file) {
    if (fs::equivalent(file.path, chosen_.file))
      out_.taken.push_back(file);
    else
      leave(file, file.what + fmt::format(": the campaign's is {}", seen_from(folder_, chosen_.file)));
  }

  void take_parameters(const FoundFile& file) {
    if (file.path == out_.campaign.parameters)
      out_.taken.push_back({file.path, file.kind, "parameter file, laid over the vehicle file"});
    else
      leave(file, "parameter file: name it under `parameters` in ident.yaml to go on from it");
  }

  void expect_something() const {
    const Campaign& c = out_.campaign;
    const bool any = !(c.thrust.empty() && c.motor.empty() && c.inertia.empty() && c.logs.empty());
    if (any || chosen_.drafted.empty()) return;
    std::string why;
    for (const FoundFile& file : out_.left) why += fmt::format("\n  {}: {}", file.path, file.what);
    throw DataError(folder_ + ": holds no log, no bench file and no vehicle file that can be read" + why);
  }

  void list_what_to_fill_in() {
    const Vehicle& vehicle = chosen_.vehicle;
    out_.fill_in = chosen_.fill_in;
    if (!vehicle.has("m")) out_.fill_in.emplace_back("mass");
    if (vehicle.rotors.empty()) out_.fill_in.emplace_back("rotors, or layout and arm");
    if (bench_pulses_ || log_pulses_)
      out_.fill_in.emplace_back("command, the pulse widths of command 0 and 1");
  }

  void list_commands() {
    const Campaign& c = out_.campaign;
    const bool flies = !chosen_.vehicle.rotors.empty() && chosen_.vehicle.has("m");
    const auto list = [&](bool has_files, bool can_run, const char* command) {
      if (has_files) (can_run ? out_.now : out_.later).emplace_back(command);
    };
    list(!c.thrust.empty(), true, "ident thrust");
    list(!c.motor.empty(), true, "ident motor");
    list(!c.inertia.empty(), true, "ident inertia");
    list(!c.logs.empty(), flies && !log_pulses_, "ident gap");
    list(!c.logs.empty(), flies && !log_pulses_, "ident flightlog --refine");
    list(true, flies, "ident check");
  }

  std::string folder_;
  std::vector<FoundFile> files_;
  ChosenVehicle chosen_;
  Vehicle assumed_;                                 // with a range of commands
  bool bench_pulses_ = false, log_pulses_ = false;  // are there, and no range of them is stated
  LaidOutCampaign out_;
};

}  // namespace

LaidOutCampaign lay_out_campaign(const std::string& folder, const std::string& vehicle) {
  const std::vector<std::string> paths = files_of_folder(folder);
  const std::string file = (fs::path(folder) / "ident.yaml").lexically_normal().string();
  if (fs::exists(file))
    throw InputError(file, 0, "",
                     "is there already, and nothing is overwritten: move it away to lay out anew");
  std::vector<FoundFile> files;
  for (const std::string& path : paths) files.push_back(recognise_file(path));
  ChosenVehicle chosen = choose_vehicle(folder, files, vehicle);
  return Layout(folder, std::move(files), std::move(chosen)).run();
}

}  // namespace ident
