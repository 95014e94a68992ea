// Priors of a campaign, from its files and the results that it keeps.
#include "campaign_priors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "ident/io/vehicle_file.h"
#include "ident/report/campaign_report.h"

namespace ident::app {
namespace {

constexpr std::array<std::string_view, 3> kBench{"thrust", "motor", "inertia"};
constexpr const char *kPriors = "priors", *kStated = "from_vehicle_file", *kLogs = "from_logs";

bool holds(const std::vector<std::string>& list, const std::string& one) {
  return std::ranges::find(list, one) != list.end();
}

std::vector<std::string> noted(const Result& refined, const char* what) {
  const auto priors = refined.extra.find(kPriors);
  return priors == refined.extra.end() ? std::vector<std::string>()
                                       : priors->value(what, std::vector<std::string>());
}

std::optional<Result> stored_refinement(const std::vector<Result>& results) {
  const auto at = std::ranges::find_if(
      results, [](const Result& r) { return r.command == "flightlog" && !r.parameters.empty(); });
  return at == results.end() ? std::nullopt : std::optional(*at);
}

// Names that the vehicle file states with a deviation and `found` does not.
std::set<std::string> stated_alone(const Vehicle& vehicle, const Vehicle& found) {
  std::set<std::string> names;
  for (const auto& [name, known] : vehicle.parameters)
    if (known.std && !found.has(name)) names.insert(name);
  return names;
}

// A parameter file without what a refinement put there: what was known before it, which may be what other
// logs told. What the vehicle file stated it states still, or states better since.
Vehicle before_refinement(Vehicle found, const Result& refined) {
  std::set<std::string> restored;
  const std::vector<std::string> stated = noted(refined, kStated);
  for (const Parameter& p : refined.parameters) {
    const auto stored = found.parameters.find(p.name);
    if (stored == found.parameters.end()) continue;
    const bool as_before = p.prior_value && stored->second.value == *p.prior_value;
    if (stored->second.value != p.value && !as_before) continue;
    if (p.prior_value && p.prior_std && !holds(stated, p.name)) {
      stored->second = {*p.prior_value, *p.prior_std};
      restored.insert(p.name);
    } else {
      found.parameters.erase(stored);
    }
  }
  found.correlation = found.correlation.part([&](const std::string& name) { return found.has(name); })
                          .renewed(refined.prior_correlation,
                                   [&](const std::string& name) { return restored.contains(name); });
  return found;
}

}  // namespace

nlohmann::ordered_json CampaignPriors::as_json() const {
  return {{kStated, std::vector<std::string>(stated.begin(), stated.end())}, {kLogs, from_logs}};
}

CampaignPriors as_stored(const Campaign& campaign) {
  CampaignPriors out{.vehicle = campaign_vehicle(campaign)};
  const bool any = std::filesystem::exists(campaign.parameters);
  out.stated =
      stated_alone(read_vehicle(campaign.vehicle), any ? read_vehicle(campaign.parameters) : Vehicle());
  return out;
}

CampaignPriors before_logs(const Campaign& campaign, const std::vector<CampaignLog>& logs) {
  CampaignPriors out = as_stored(campaign);
  const std::vector<Result> results = stored_results(".");
  const std::optional<Result> refined = stored_refinement(results);
  if (!refined || !std::filesystem::exists(campaign.parameters)) return out;
  out.from_logs = noted(*refined, kLogs);
  const auto is_of = [](const std::vector<std::string>& files) {
    return [&](const CampaignLog& log) { return holds(files, log.file); };
  };
  if (std::ranges::any_of(logs, is_of(refined->inputs))) {
    const Vehicle found = before_refinement(read_vehicle(campaign.parameters), *refined);
    Vehicle vehicle = read_vehicle(campaign.vehicle), bench;
    for (const Result& result : results)
      if (std::ranges::find(kBench, result.command) != kBench.end()) bench = with_result(bench, result);
    bench = with_parameters(bench, found);
    out.stated = stated_alone(vehicle, bench);
    out.vehicle = with_parameters(std::move(vehicle), bench);
    out.notices.emplace_back(
        "priors: what was known before the stored refinement, which used these logs already");
  } else {
    for (const std::string& log : refined->inputs)
      if (!holds(out.from_logs, log)) out.from_logs.push_back(log);
  }
  for (const CampaignLog& log : logs)
    if (is_of(out.from_logs)(log))
      out.warnings.push_back(
          {"counted_twice",
           fmt::format("{}: what is known of this vehicle beforehand comes from this log too, by "
                       "an earlier refinement, so it counts twice and intervals are too narrow. "
                       "Refine all logs at once, or begin anew without {}.",
                       log.file, campaign.parameters)});
  return out;
}

std::string replaced_by_bench(const Campaign& campaign, const Result& bench) {
  const std::vector<Result> results = stored_results(".");
  const std::optional<Result> refined = stored_refinement(results);
  if (!refined || !std::filesystem::exists(campaign.parameters)) return {};
  const Vehicle found = read_vehicle(campaign.parameters);
  std::vector<std::string> replaced;
  for (const Parameter& p : refined->parameters)
    if (found.has(p.name) && found.value(p.name) == p.value && with_result({}, bench).has(p.name))
      replaced.push_back(p.name);
  if (replaced.empty()) return {};
  return fmt::format(
      "{}: what a refinement found is replaced by what the bench says; the rest of what it found rests on "
      "what "
      "the bench said then: run `ident flightlog --refine` again",
      fmt::join(replaced, ", "));
}

}  // namespace ident::app
