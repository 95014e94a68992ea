// Keeps and gathers the results of a campaign.
#include "ident/report/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"
#include "ident/io/campaign/campaign.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/file/sha256.h"
#include "ident/model/parameters.h"
#include "ident/report/blocks.h"
#include "ident/report/stored_result.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = ".ident";
constexpr std::size_t kLargest = std::size_t{1} << 30;  // bytes of a stored result
constexpr std::array<std::string_view, 8> kOrder{"thrust",    "motor", "inertia", "flightlog-refine",
                                                 "flightlog", "gap",   "slant",   "check"};

/// Command, with what makes two of its results worth keeping side by side.
std::string name_of(const Result& result) {
  const bool refined = std::ranges::count(result.command_line, "--refine") > 0;
  return result.command + (refined ? "-refine" : "");
}

std::size_t place_in_order(const fs::path& file) {
  return static_cast<std::size_t>(std::ranges::find(kOrder, file.stem().string()) - kOrder.begin());
}

Result read_stored_result(const fs::path& file) {
  try {
    return result_from_json(nlohmann::ordered_json::parse(read_bytes(file.string(), kLargest)));
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string(), 0, "",
                     "is not a stored result; run the command again, or remove the file");
  }
}

// `written`: the parameter file, which commands themselves change.
void warn_of_changed_inputs(Result& result, const fs::path& folder, const std::string& written) {
  const bool refined = std::ranges::count(result.command_line, "--refine") > 0;
  for (const InputFile& input : result.files) {
    const std::string path = (folder / input.path).lexically_normal().string();
    if (path == written) continue;
    if (fs::is_regular_file(path) && sha256_of_file(path) == input.sha256) continue;
    result.warn("stale_result", fmt::format("{} has changed since, or is gone: run `ident {}{}` again.",
                                            input.path, result.command, refined ? " --refine" : ""));
  }
}

Parameter stated(const Vehicle& vehicle, const std::string& name) {
  const Known& known = vehicle.parameters.at(name);
  const double std = known.std.value_or(kNaN);
  return {.name = name,
          .value = known.value,
          .std = std,
          .ci95 = {known.value - 1.96 * std, known.value + 1.96 * std},
          .unit = parameter_unit(name),
          .source = "prior"};
}

/// Adds what one more result found of a parameter. What the parameter file holds counts, whichever result
/// stored it; else the later one that determines it. Of one that flights know together with others only, what
/// the bench determines stays determined.
void add_found(const Parameter& found, const Vehicle& vehicle, std::vector<Parameter>& all) {
  const auto at = std::ranges::find(all, found.name, &Parameter::name);
  if (at == all.end()) {
    all.push_back(found);
    return;
  }
  const auto is_stored = [&](const Parameter& p) {
    return vehicle.has(p.name) && vehicle.value(p.name) == p.value;
  };
  if (is_stored(*at) && !is_stored(found)) return;
  if (!is_stored(found) && !found.identifiable && at->identifiable) return;
  const Parameter before = *at;
  *at = found;
  if (found.identifiable || !before.identifiable) return;
  at->identifiable = true, at->note.clear();
  at->source = before.source + ", " + found.source;
}

std::string counted(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace

std::string stored_result_path(const std::string& folder, const Result& result) {
  return (fs::path(folder) / kFolder / (name_of(result) + ".json")).lexically_normal().string();
}

std::string stored_result_text(const Result& result) {
  // File names may hold bytes that are no UTF-8: replaced, not refused.
  return stored_json(result).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<Result> stored_results(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code no_folder;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / kFolder, no_folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) { return std::pair(place_in_order(file), file); });
  const std::optional<Campaign> campaign = find_campaign(folder);
  std::vector<Result> results;
  for (const fs::path& file : files) {
    results.push_back(read_stored_result(file));
    warn_of_changed_inputs(results.back(), folder, campaign ? campaign->parameters : "");
  }
  return results;
}

Result vehicle_summary(const Vehicle& vehicle) {
  Result summary;
  summary.command = "report";
  summary.inputs = {vehicle.file};
  summary.warnings = vehicle.warnings;
  for (const auto& [name, known] : vehicle.parameters) summary.parameters.push_back(stated(vehicle, name));
  return summary;
}

Result campaign_summary(const Vehicle& vehicle, const std::vector<Result>& results) {
  Result summary;
  summary.command = "report";
  summary.inputs = {vehicle.file};
  summary.warnings = vehicle.warnings;
  Table commands{.columns = {"Command", "What it found"}};
  for (const Result& result : results) {
    commands.rows.push_back({title_of(result), verdict_of(result)});
    for (const Warning& warning : result.warnings)
      summary.warn(warning.code, "ident " + result.command + ": " + warning.message);
    if (is_diagnosis(result)) continue;  // it keeps nothing in the parameter file
    for (const Parameter& found : result.parameters) add_found(found, vehicle, summary.parameters);
  }
  const auto unknown = std::ranges::count(summary.parameters, false, &Parameter::identifiable);
  const std::size_t found = summary.parameters.size();
  for (const auto& [name, known] : vehicle.parameters)
    if (summary.find(name) == nullptr) summary.parameters.push_back(stated(vehicle, name));
  summary.verdict =
      fmt::format("{}: {} from {}, {} of them identified.",
                  vehicle.name.empty() ? "The vehicle" : vehicle.name, counted(found, "parameter"),
                  counted(results.size(), "result"), found - static_cast<std::size_t>(unknown));
  for (const Result& result : results)
    if (is_diagnosis(result)) summary.verdict += " " + result.verdict;
  summary.sections.push_back({.title = "What each command found", .tables = {std::move(commands)}});
  return summary;
}

}  // namespace ident
