// Reads ident.yaml and lays estimates over what is known.
#include "ident/io/campaign/campaign.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/io/file/yaml_value.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "ident.yaml";
constexpr double kCorrected = 5.0;  // standard deviations, beyond what chance does
const std::vector<std::string> kKeys = {"vehicle", "parameters", "thrust", "motor",
                                        "inertia", "map",        "logs",   "air"};

/// The path of a file that a value names; it has to exist unless it is still to be written.
std::string named_file(const YamlValue& value, const fs::path& folder, bool has_to_exist = true) {
  const std::string text = value.text();
  if (text.empty()) value.fail("names no file");
  const fs::path path = (folder == "." ? fs::path(text) : folder / text).lexically_normal();
  if (has_to_exist && !fs::exists(path)) value.fail("there is no file '" + path.string() + "'");
  return path.string();
}

std::vector<YamlValue> one_or_many(const YamlValue& value) {
  return value.is_list() ? value.list() : std::vector<YamlValue>{value};
}

std::vector<std::string> named_files(const YamlValue& file, const std::string& key, const fs::path& folder) {
  std::vector<std::string> paths;
  if (!file.has(key)) return paths;
  for (const YamlValue& value : one_or_many(file.at(key))) paths.push_back(named_file(value, folder));
  return paths;
}

CampaignLog read_log(const YamlValue& value, const fs::path& folder, const std::string& common_map) {
  static const std::vector<std::string> keys = {"file", "map", "motion", "motion_map"};
  if (!value.is_map()) return {named_file(value, folder), common_map};
  value.expect_map(keys);
  const auto named = [&](const char* key, const std::string& otherwise) {
    return value.has(key) ? named_file(value.at(key), folder) : otherwise;
  };
  return {named_file(value.at("file"), folder), named("map", common_map), named("motion", ""),
          named("motion_map", "")};
}

/// What the vehicle file states otherwise than it can have been when the parameter file was written.
std::vector<Warning> stated_otherwise(const Vehicle& vehicle, const Vehicle& found) {
  std::vector<Warning> warnings;
  for (const auto& [name, known] : found.parameters) {
    const auto stated = vehicle.parameters.find(name);
    if (stated == vehicle.parameters.end() || !stated->second.std) continue;
    const double off = std::abs(known.value - stated->second.value) /
                       std::hypot(*stated->second.std, known.std.value_or(0.0));
    if (!(off > kCorrected)) continue;
    warnings.push_back(
        {"stated_otherwise",
         fmt::format(
             "{}: {} = {} takes the place of {} in {}, {:.0f} standard deviations off. If the latter was "
             "corrected since, run `ident flightlog --refine` again, or take {} out of {}.",
             found.file, name, format_with_uncertainty(known.value, known.std.value_or(kNaN)),
             format_with_uncertainty(stated->second.value, *stated->second.std), vehicle.file, off, name,
             found.file)});
  }
  return warnings;
}

}  // namespace

std::optional<Campaign> find_campaign(const std::string& folder) {
  if (!fs::exists(fs::path(folder) / kFile)) return std::nullopt;
  return read_campaign(folder);
}

Campaign read_campaign(const std::string& folder) {
  const fs::path place(folder.empty() ? "." : folder);
  Campaign campaign;
  campaign.file = (place / kFile).lexically_normal().string();
  const YamlValue file = load_yaml(campaign.file);
  file.expect_map(kKeys);
  if (file.has("air")) campaign.air = read_air(file.at("air"));
  campaign.vehicle = named_file(file.at("vehicle"), place);
  campaign.parameters = file.has("parameters") ? named_file(file.at("parameters"), place, false)
                                               : (place / "parameters.yaml").lexically_normal().string();
  campaign.thrust = named_files(file, "thrust", place);
  campaign.motor = named_files(file, "motor", place);
  campaign.inertia = named_files(file, "inertia", place);
  const std::string map = file.has("map") ? named_file(file.at("map"), place) : "";
  if (file.has("logs"))
    for (const YamlValue& value : one_or_many(file.at("logs")))
      campaign.logs.push_back(read_log(value, place, map));
  return campaign;
}

Vehicle campaign_vehicle(const Campaign& campaign) {
  return campaign_vehicle(campaign,
                          fs::exists(campaign.parameters) ? read_vehicle(campaign.parameters) : Vehicle());
}

Vehicle campaign_vehicle(const Campaign& campaign, const Vehicle& found) {
  Vehicle vehicle = read_vehicle(campaign.vehicle);
  if (campaign.air) vehicle.air = campaign.air;  // of these flights; the vehicle file may serve others
  const std::vector<Warning> warnings = stated_otherwise(vehicle, found);
  vehicle.warnings.insert(vehicle.warnings.end(), warnings.begin(), warnings.end());
  return with_parameters(std::move(vehicle), found);
}

std::string updated_parameters(const Campaign& campaign, const Result& result) {
  const bool exists = fs::exists(campaign.parameters);
  return vehicle_to_yaml(with_result(exists ? read_vehicle(campaign.parameters) : Vehicle(), result));
}

}  // namespace ident
