// Priors of a campaign, from its files and the history of its flights.
#include "campaign_priors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "ident/io/file/sha256.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "ident/report/campaign_report.h"

namespace ident::app {
namespace {

Vehicle parameter_file(const Campaign& campaign) {
  return std::filesystem::exists(campaign.parameters) ? read_vehicle(campaign.parameters) : Vehicle();
}

bool holds(const std::vector<InputFile>& files, const InputFile& one) {
  return std::ranges::find(files, one.sha256, &InputFile::sha256) != files.end();
}

std::vector<InputFile> identified(const std::vector<CampaignLog>& logs) {
  std::vector<InputFile> files;
  std::error_code unreadable;  // which the reader tells
  for (const CampaignLog& log : logs)
    if (std::filesystem::is_regular_file(log.file, unreadable))
      files.push_back({log.file, sha256_of_file(log.file)});
  return files;
}

// Logs of a refinement whose values the parameter file holds, by a version that kept no history.
std::vector<InputFile> refined_without_history(const Vehicle& found) {
  const auto is_in_file = [&](const Parameter& p) {
    return found.has(p.name) && found.value(p.name) == p.value;
  };
  std::vector<CampaignLog> logs;
  for (const Result& r : stored_results("."))
    if (r.command == "flightlog" && std::ranges::any_of(r.parameters, is_in_file))
      for (const std::string& log : r.inputs) logs.push_back({log, {}});
  return identified(logs);
}

}  // namespace

CampaignPriors before_logs(const Campaign& campaign, const std::vector<CampaignLog>& logs) {
  CampaignPriors out;
  FlightHistory& history = out.history;
  history.before = parameter_file(campaign);
  history.logs = identified(logs);
  const auto used_by = [](const std::vector<InputFile>& files) {
    return [&](const InputFile& log) { return holds(files, log); };
  };
  const std::optional<FlightHistory> last = read_flight_history();
  if (!last) {
    history.earlier = refined_without_history(history.before);
  } else if (last->is_in(history.before)) {  // else the parameter file was begun anew
    history.earlier = last->earlier;
    if (std::ranges::any_of(history.logs, used_by(last->logs))) {
      history.before = last->undone(history.before);
      out.notices.emplace_back(
          "priors: what was known before the stored refinement, which used these logs already");
    } else {
      history.earlier.insert(history.earlier.end(), last->logs.begin(), last->logs.end());
    }
  }
  for (const InputFile& log : history.logs)
    if (used_by(history.earlier)(log))
      out.warnings.push_back(
          {"counted_twice",
           fmt::format("{}: what is known of this vehicle beforehand comes from this log too, by "
                       "an earlier refinement, so it counts twice and intervals are too narrow. "
                       "Refine all logs at once, or begin anew without {}.",
                       log.path, campaign.parameters)});
  out.vehicle = campaign_vehicle(campaign, history.before);
  return out;
}

std::optional<Warning> replaces_refined(const Campaign& campaign, const Result& bench) {
  const std::optional<FlightHistory> last = read_flight_history();
  if (!last) return std::nullopt;
  const Vehicle now = parameter_file(campaign), measured = with_result({}, bench);
  std::vector<std::string> replaced;
  for (const auto& [name, known] : measured.parameters)
    if (now.has(name) && last->after.has(name) && now.value(name) == last->after.value(name) &&
        now.value(name) != known.value)
      replaced.push_back(name);
  if (replaced.empty()) return std::nullopt;
  return Warning{
      "refine_again",
      fmt::format("{}: the bench values replace those of a refinement, and the other refined constants rest "
                  "on the earlier bench values. Run `ident flightlog --refine` again.",
                  fmt::join(replaced, ", "))};
}

}  // namespace ident::app
