// Writes the lists of a campaign that was laid out.
#include "ident/views/campaign_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "ident/io/campaign/campaign_write.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLeft = 20;  // lines of files that are left alone

const char* key_of(FileKind kind) {
  switch (kind) {
    case FileKind::thrust:
      return "thrust";
    case FileKind::motor:
      return "motor";
    case FileKind::inertia:
      return "inertia";
    case FileKind::flight_log:
    case FileKind::autopilot_log:
      return "logs";
    case FileKind::map:
      return "map";
    case FileKind::vehicle:
    case FileKind::simulator:
      return "vehicle";
    case FileKind::parameters:
      return "parameters";
    case FileKind::table:
    case FileKind::other:
      break;
  }
  return "";
}

std::string file_lines(const std::vector<FoundFile>& files, const std::string& folder, std::size_t most) {
  std::size_t width = 0;
  for (const FoundFile& file : files) width = std::max(width, seen_from(folder, file.path).size());
  std::string text;
  for (const FoundFile& file : std::span(files).first(std::min(most, files.size())))
    text += fmt::format("  {:<{}}  {}\n", seen_from(folder, file.path), width, file.what);
  if (files.size() > most) text += fmt::format("  and {} more: --json lists all\n", files.size() - most);
  return text;
}

std::string next_lines(const LaidOutCampaign& layout, const std::string& folder) {
  std::string text = "Next:\n";
  if (!layout.fill_in.empty())
    text += fmt::format("  fill in {}: {}\n", layout.campaign.vehicle, fmt::join(layout.fill_in, "; "));
  if (seen_from(".", folder) != ".") text += fmt::format("  cd {}\n", folder);
  if (!layout.now.empty()) text += fmt::format("  these work now: {}\n", fmt::join(layout.now, ", "));
  if (!layout.later.empty())
    text += fmt::format("  once that is filled in: {}\n", fmt::join(layout.later, ", "));
  return text;
}

}  // namespace

std::string layout_text(const LaidOutCampaign& layout, const std::string& folder) {
  std::string text = fmt::format("{} is written.\n", layout.campaign.file);
  if (!layout.drafted.empty()) text += fmt::format("{} is drafted.\n", layout.campaign.vehicle);
  if (!layout.taken.empty()) text += "Taken:\n" + file_lines(layout.taken, folder, layout.taken.size());
  if (!layout.left.empty()) text += "Left alone:\n" + file_lines(layout.left, folder, kMostLeft);
  return text + next_lines(layout, folder);
}

Json layout_json(const LaidOutCampaign& layout, const std::string& folder) {
  Json out{{"campaign", layout.campaign.file},
           {"vehicle",
            {{"file", seen_from(folder, layout.campaign.vehicle)},
             {"drafted", !layout.drafted.empty()},
             {"fill_in", layout.fill_in}}},
           {"taken", Json::array()},
           {"left", Json::array()},
           {"next", {{"now", layout.now}, {"after_filling_in", layout.later}}}};
  for (const FoundFile& file : layout.taken)
    out["taken"].push_back(
        {{"file", seen_from(folder, file.path)}, {"key", key_of(file.kind)}, {"what", file.what}});
  for (const FoundFile& file : layout.left)
    out["left"].push_back({{"file", seen_from(folder, file.path)}, {"why", file.what}});
  return out;
}

}  // namespace ident
