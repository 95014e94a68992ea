// One key a line; lists of several files below each other.
#include "ident/io/campaign/campaign_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "ident/io/vehicle/vehicle_write.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

/// A name that YAML reads as it stands; other names are quoted.
std::string yaml_name(const std::string& name) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  };
  const bool is_plain =
      std::ranges::all_of(name, plain) && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  return is_plain ? name : quoted(name);
}

std::string key_of(const char* key, const std::vector<std::string>& values) {
  if (values.empty()) return "";
  if (values.size() == 1 && !values.front().starts_with('{'))
    return fmt::format("{}: {}\n", key, values.front());
  std::string text = fmt::format("{}:\n", key);
  for (const std::string& value : values) text += fmt::format("  - {}\n", value);
  return text;
}

}  // namespace

std::string seen_from(const std::string& folder, const std::string& path) {
  fs::path from = fs::absolute(folder).lexically_normal();
  if (!from.has_filename()) from = from.parent_path();  // of "a/" and "."
  return fs::absolute(path).lexically_normal().lexically_proximate(from).generic_string();
}

std::string campaign_text(const Campaign& campaign, const std::string& folder) {
  const auto name = [&](const std::string& path) { return yaml_name(seen_from(folder, path)); };
  const auto names = [&](const std::vector<std::string>& paths) {
    std::vector<std::string> out;
    for (const std::string& path : paths) out.push_back(name(path));
    return out;
  };
  std::vector<std::string> logs;
  for (const CampaignLog& log : campaign.logs) {
    std::string beside;
    for (const auto& [key, path] :
         {std::pair("map", log.map), {"motion", log.motion}, {"motion_map", log.motion_map}})
      if (!path.empty()) beside += fmt::format(", {}: {}", key, name(path));
    logs.push_back(beside.empty() ? name(log.file) : fmt::format("{{file: {}{}}}", name(log.file), beside));
  }
  return "# The files of one vehicle: commands that run in this folder take theirs from here.\n" +
         fmt::format("vehicle: {}\n", name(campaign.vehicle)) +
         fmt::format("{:<30} # where commands store what they find\n",
                     fmt::format("parameters: {}", name(campaign.parameters))) +
         key_of("thrust", names(campaign.thrust)) + key_of("motor", names(campaign.motor)) +
         key_of("inertia", names(campaign.inertia)) + key_of("logs", logs);
}

}  // namespace ident
