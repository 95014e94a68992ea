// The command that a user probably wants next.
#include <algorithm>
#include <array>

#include "ident/io/campaign/campaign.h"
#include "shell.h"

namespace ident::app {
namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::count(words, word) > 0;
}

/// Value of an option on the command line, or what stands for it in an example.
std::string option_value(const std::vector<std::string>& words, const std::string& name,
                         const std::string& otherwise) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == name && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(name + "=")) return words[i].substr(name.size() + 1);
  }
  return otherwise;
}

/// The commands of a campaign in the order in which they build on each other.
constexpr std::array<std::string_view, 8> kSteps{"thrust", "motor", "inertia", "gap", "flightlog --refine",
                                                 "slant",  "check", "report"};

bool has_files(const Campaign& campaign, std::string_view step) {
  if (step == "thrust") return !campaign.thrust.empty();
  if (step == "motor") return !campaign.motor.empty();
  if (step == "inertia") return !campaign.inertia.empty();
  return (step != "gap" && step != "flightlog --refine") || !campaign.logs.empty();
}

std::string next_in_campaign(const Campaign& campaign, const std::string& step) {
  if (step == "flightlog") return "ident flightlog --refine";
  auto at = std::ranges::find(kSteps, step);
  if (at == kSteps.end()) return "ident report";
  for (++at; at != kSteps.end(); ++at)
    if (has_files(campaign, *at)) return "ident " + std::string(*at);
  return "";
}

/// Logs, and what they were read with.
std::string logs_of(const Result& result, const std::vector<std::string>& words) {
  std::string logs;
  for (const std::string& input : result.inputs) logs += " " + input;
  for (std::size_t i = 0; i < words.size(); ++i)
    for (const char* option : {"--map", "--motion", "--motion-map"}) {
      if (words[i] == option && i + 1 < words.size()) logs += " " + words[i] + " " + words[i + 1];
      if (words[i].starts_with(option + std::string("="))) logs += " " + words[i];
    }
  return logs;
}

/// What follows from files that were named, where something does.
std::string next_with_files(const Result& result, const std::vector<std::string>& words) {
  const std::string vehicle = option_value(words, "--vehicle", "VEHICLE.yaml");
  if (result.command == "gap") {
    if (has(words, "--simulated")) return "";
    const std::string better = option_value(words, "--fix", option_value(words, "--write-params", ""));
    if (!better.empty()) return "ident gap" + logs_of(result, words) + " --vehicle " + better;
    const bool named = !result.extra.at("verdict").at("effects").empty();
    return named ? "ident gap" + logs_of(result, words) + " --vehicle " + vehicle +
                       " --write-params better.yaml"
                 : "";
  }
  if (result.command == "flightlog") {
    const std::string same = logs_of(result, words) + " --vehicle " + vehicle;
    return has(words, "--refine") ? "ident gap" + same : "ident flightlog" + same + " --refine";
  }
  if (result.command != "simulate") return "";
  const std::string output = result.extra.at("output");
  for (const char* kind : {"thrust", "motor", "inertia"})
    if (has(words, kind)) return "ident " + std::string(kind) + " " + output;
  return "ident gap " + output + " --vehicle " + vehicle;
}

}  // namespace

std::string next_command(const Result& result, const Context& context) {
  const std::vector<std::string>& words = context.command_line;
  if (!has(context.used, "ident.yaml")) return next_with_files(result, words);
  const std::optional<Campaign> campaign = find_campaign();
  if (!campaign || result.command == "report") return "";
  return next_in_campaign(*campaign, result.command + (has(words, "--refine") ? " --refine" : ""));
}

}  // namespace ident::app
