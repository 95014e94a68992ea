// Tells a diagnosis: how far the gap closes, which causes, where it lies, and what was tried.
#include "ident/gap/views/gap_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ident/core/format_number.h"
#include "ident/core/word_list.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/gap/statistics/by_channel.h"
#include "ident/gap/views/gap_pictures.h"
#include "ident/gap/views/signature_plot.h"

namespace ident {
namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;

constexpr double kMuch = 0.4;  // share of a quarter of the flight that is worth a sentence

double number_of(const Json& j) { return j.is_number() ? j.get<double>() : kNaN; }

std::string percent(const Json& share) {
  return std::isfinite(number_of(share)) ? fmt::format("{:.0f}", 100 * number_of(share)) : "–";
}

std::vector<std::string> words(const Json& list) { return list.get<std::vector<std::string>>(); }

std::string number_text(const Json& j, int digits = 3) { return format_number(number_of(j), digits); }

std::string value_text(const Json& parameter) {
  return format_with_uncertainty(number_of(parameter["value"]), number_of(parameter["std"])) +
         (parameter["unit"] == "-" ? "" : " " + parameter["unit"].get<std::string>());
}

/// The causes of the verdict, or the nearest ones where nothing explains the gap.
std::vector<std::string> causes_of(const Json& found) {
  const Json& verdict = found["verdict"];
  std::vector<std::string> effects = words(verdict["effects"]);
  return effects.empty() && verdict["status"] == "unknown" ? words(verdict["confused_with"]) : effects;
}

std::string how_far(const Json& gap, const std::string& causes) {
  if (!std::isfinite(number_of(gap["before"])))
    return "No held-out flight could be predicted half a second ahead.";
  const std::string with = causes.empty() ? "its constants refitted" : causes + " in it";
  std::string text = fmt::format(
      "Half a second ahead the model as given misses by {} times the sensor noise; with {}, by {} times. A "
      "perfect model would miss by {}, because sensors are noisy and nobody knows exactly how a window "
      "begins.",
      number_text(gap["before"]), with, number_text(gap["after"]), number_text(gap["noise_floor"]));
  if (!std::isfinite(number_of(gap["closed"]))) return text + " At this horizon there was no gap to close.";
  return text + fmt::format(" That closes {} % of the gap (95 %: {} to {} %).", percent(gap["closed"]),
                            percent(gap["closed_ci95"][0]), percent(gap["closed_ci95"][1]));
}

// Whether held-out flight was long enough for that horizon.
bool predicted(const Json& horizon) { return std::isfinite(number_of(horizon["before"])); }

Table horizon_table(const Json& gap) {
  Table table{.title = "By how far ahead",
              .columns = {"horizon [s]", "as given", "left", "noise floor", "closed [%]", "95 % interval"}};
  if (!gap.contains("horizons")) return table;
  for (const Json& h : gap["horizons"])
    if (predicted(h))
      table.rows.push_back(
          {number_text(h["horizon"]), number_text(h["before"]), number_text(h["after"]),
           number_text(h["noise_floor"]), percent(h["closed"]),
           fmt::format("[{}, {}]", percent(h["closed_ci95"][0]), percent(h["closed_ci95"][1]))});
  return table;
}

// The same in the units that a pilot feels, with what else moves as measured.
Table motion_table(const Json& gap) {
  Table table{
      .title =
          "Velocity with attitude and rates as measured, rates with velocity as measured, attitude open "
          "loop, "
          "rotor speeds by their commands",
      .columns = {"predicted", "horizon [s]", "as stated", "with what was found", "noise floor", "unit"}};
  constexpr std::array kRows{std::array{"forces", "velocity"}, std::array{"moments", "rates"},
                             std::array{"open_loop", "attitude"}, std::array{"rotor_speeds", "rotors"}};
  for (const auto& [key, predicted_by] : kRows) {
    if (!gap.contains(key) || !gap[key].is_object()) continue;
    std::string name = predicted_by;
    for (const Json& h : gap[key]["horizons"]) {
      if (!predicted(h)) continue;
      table.rows.push_back({std::exchange(name, ""), number_text(h["seconds"]), number_text(h["before"]),
                            number_text(h["after"]), number_text(h["noise_floor"], 2), gap[key]["unit"]});
    }
  }
  return table;
}

// Each cause named: is it there, and what does it close; and what is left.
Table share_table(const Json& found) {
  Table table{.title = "What closes the gap that refitted constants leave",
              .columns = {"", "probability", "share [%]", "95 % interval"}};
  const auto row = [&](const std::string& name, const Json& probability, const Json& share,
                       const Json& ci95) {
    const double p = number_of(probability);
    table.rows.push_back({name, std::isfinite(p) ? fmt::format("{:.2f}", p) : "–", percent(share),
                          fmt::format("[{}, {}]", percent(ci95[0]), percent(ci95[1]))});
  };
  for (const Json& c : found["candidates"])
    if (c.contains("share")) row(c["effect"], c["probability"], c["share"], c["share_ci95"]);
  const Json& verdict = found["verdict"];
  if (verdict.contains("remaining") && verdict["remaining"].is_object() && !table.rows.empty()) {
    const Json& left = verdict["remaining"];
    row("what is left", left["probability"], left["share"], left["share_ci95"]);
  }
  return table;
}

Section how_section(const Json& found, const std::string& causes) {
  Section section{.title = "How far the gap closes",
                  .text = how_far(found["gap"], causes),
                  .tables = {horizon_table(found["gap"])},
                  .plots = {waterfall_plot(found, causes)}};
  if (Table shares = share_table(found); !shares.rows.empty())
    section.tables.insert(section.tables.begin(), std::move(shares));
  if (Table felt = motion_table(found["gap"]); !felt.rows.empty()) section.tables.push_back(std::move(felt));
  if (Plot shares = shares_plot(found); !shares.series.empty())
    section.plots.insert(section.plots.begin(), std::move(shares));
  return section;
}

const Json* candidate(const Json& found, const std::string& name) {
  const Json& list = found["candidates"];
  const auto at = std::ranges::find_if(list, [&](const Json& c) { return c["effect"] == name; });
  return at == list.end() ? nullptr : &*at;
}

/// What a named cause is, how large it was found, and what to fly to be sure of it.
void add_cause(Table& table, const Json& found, const std::string& name) {
  std::string size;
  if (const Json* c = candidate(found, name))
    for (const auto& [parameter, value] : (*c)["parameters"].items())
      size += (size.empty() ? "" : "; ") + parameter + " = " + value_text(value);
  table.rows.push_back({name, "size", size.empty() ? "–" : size});
  const EffectEntry* effect = find_effect(name);
  if (effect == nullptr) return;
  table.rows.push_back({"", "equation", std::string(effect->info.equation)});
  table.rows.push_back({"", "looks like", std::string(effect->info.looks_like)});
  table.rows.push_back({"", "to be sure", std::string(effect->info.split_by)});
}

/// The causal test: a true cause has one size in all that a flight shows.
Table by_channel_table(const Json& found) {
  Table table{.title = "What each channel asks of a cause's size",
              .columns = {"cause", "channel", "change [%]", "±", "share of what is known [%]"}};
  if (!found.contains("by_channel")) return table;
  for (const auto& [cause, parts] : found["by_channel"].items())
    for (const auto& [part, asked] : parts.items()) {
      if (!(number_of(asked["weight"]) >= kHasASay)) continue;
      const double change = 100 * number_of(asked["change"]), std = 100 * number_of(asked["std"]);
      const int decimals = std > 0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(std))), 0, 3) : 0;
      table.rows.push_back({cause, part, fmt::format("{:+.{}f}", change, decimals),
                            fmt::format("{:.{}f}", std, decimals), percent(asked["weight"])});
    }
  return table;
}

Section which_section(const Json& found) {
  Section section{.title = "Which causes"};
  const bool named = !found["verdict"]["effects"].empty();
  Table table{.title = named ? "The causes named" : "The nearest causes, which are not named",
              .columns = {"cause", "", "what is known"}};
  for (const char* list : {"effects", "confused_with"})
    for (const std::string& name : words(found["verdict"][list])) add_cause(table, found, name);
  if (!table.rows.empty()) section.tables.push_back(std::move(table));
  if (Table asked = by_channel_table(found); !asked.rows.empty()) {
    section.text =
        "A true cause has one size in all that a flight shows. The second table says by how much of itself "
        "each channel would change it; what is within twice its deviation is chance.";
    section.tables.push_back(std::move(asked));
  }
  if (Plot plot = probability_plot(found["candidates"]); !plot.series.empty())
    section.plots.push_back(std::move(plot));
  return section;
}

std::string where_text(const Json& where) {
  const Json& channels = where["channels"];
  if (channels.empty() || !(number_of(channels[0]["share"]) > 0)) return "No channel stands above its noise.";
  std::string text = fmt::format("{} % of it is in {}.", percent(channels[0]["share"]),
                                 channels[0]["name"].get<std::string>());
  if (const Json& regimes = where["regimes"]; !regimes.empty() && number_of(regimes[0]["share"]) > kMuch) {
    const std::string variable = regimes[0]["variable"], unit = regime_unit(variable);
    text += fmt::format(" {} % of it lies in the quarter of the flight with {} from {} to {}{}.",
                        percent(regimes[0]["share"]), variable, number_text(regimes[0]["bin"][0]),
                        number_text(regimes[0]["bin"][1]), unit == "-" ? "" : " " + unit);
  }
  const auto share = [](const Json& band) { return number_of(band["share"]); };
  if (const Json& bands = where["bands"]; !bands.empty()) {
    const Json& top = *std::ranges::max_element(bands, {}, share);
    if (share(top) > 0) text += fmt::format(" {} % of it is at {}.", percent(top["share"]), band_name(top));
  }
  return text;
}

Table channel_table(const Json& where) {
  Table table{.title = "Residual force and moment",
              .columns = {"channel", "rms", "noise", "unit", "share [%]"}};
  for (const Json& c : where["channels"])
    table.rows.push_back({c["name"], number_text(c["rms"]), number_text(c["noise"]),
                          channel_unit(c["name"].get<std::string>()), percent(c["share"])});
  return table;
}

Table regime_table(const Json& where) {
  Table table{.title = "In which quarter of the flight (by chance 25 % each)",
              .columns = {"variable", "from", "to", "unit", "share [%]"}};
  for (const Json& r : where["regimes"])
    table.rows.push_back({r["variable"], number_text(r["bin"][0]), number_text(r["bin"][1]),
                          regime_unit(r["variable"]), percent(r["share"])});
  return table;
}

Table time_table(const Json& where) {
  Table table{.title = "When", .columns = {"log", "from [s]", "to [s]", "share [%]"}};
  for (const Json& t : where["times"])
    table.rows.push_back({t.contains("log") ? t["log"].dump() : "1", number_text(t["from"], 4),
                          number_text(t["to"], 4), percent(t["share"])});
  return table;
}

Section where_section(const Json& found, const ResidualWrench& before, const ResidualWrench& after) {
  const Json& where = found["where"];
  if (found["verdict"]["status"] == "none")
    return {
        .title = "Where the gap lies",
        .text =
            "No channel stands clearly above its noise. The shares of the little that is left are chance.",
        .tables = {channel_table(where)}};
  Section section{.title = "Where the gap lies",
                  .text = where_text(where),
                  .tables = {channel_table(where), regime_table(where), time_table(where)},
                  .plots = {channel_plot(where)}};
  // Without a gap there is nothing to have shares of.
  if (std::ranges::any_of(where["bands"], [](const Json& band) { return number_of(band["share"]) > 0; }))
    section.plots.push_back(band_plot(where));
  if (!where["channels"].empty() && !where["regimes"].empty()) {
    const auto top = std::ranges::find(before.names, where["channels"][0]["name"].get<std::string>());
    section.plots.push_back(
        residual_over_regime(before, after, top - before.names.begin(), where["regimes"][0]["variable"]));
  }
  return section;
}

std::string limit_unit(const std::string& name) {
  return name == "ground_effect.radius" ? "m" : parameter_unit(name);  // the parameter is its square
}

Section tried_section(const Json& found) {
  Table table{.title = "Every cause, and the size that would have been seen",
              .columns = {"cause", "probability", "evidence", "would have been seen"}};
  for (const Json& c : found["candidates"]) {
    std::string limits;
    for (const auto& [name, limit] : c["detection_limit"].items()) {
      const std::string unit = limit_unit(name);
      limits += (limits.empty() ? "" : ", ") + name.substr(name.find('.') + 1) + " " + number_text(limit, 2);
      if (unit != "-") limits += " " + unit;
    }
    table.rows.push_back({c["effect"], fmt::format("{:.3f}", number_of(c["probability"])),
                          c.contains("evidence") ? fmt::format("{:.1f}", number_of(c["evidence"])) : "–",
                          limits});
  }
  std::string text =
      "The last column is the size that would have been found in these logs in nine of ten cases; "
      "evidence is the fall of the misfit with that cause alone.";
  for (const Json& c : found["not_tried"])
    text += fmt::format("{}{} ({})", &c == &found["not_tried"].front() ? " Not tried: " : ", ",
                        c["effect"].get<std::string>(), c["why"].get<std::string>());
  if (!found["not_tried"].empty()) text += ".";
  return {.title = "What was tried", .text = std::move(text), .tables = {std::move(table)}};
}

Section traces(const ResidualWrench& before, const ResidualWrench& after) {
  Section section{.title = "The residual over time",
                  .text = "Force and moment on the body that the model does not explain, in the first log."};
  for (Index c = 0; c < std::min<Index>(before.residual.cols(), 6); ++c)
    section.plots.push_back(residual_over_time(before, after, c));
  return section;
}

}  // namespace

std::vector<Section> gap_sections(const Json& found, const ResidualWrench& before,
                                  const ResidualWrench& after, const GapEvidence& evidence) {
  const std::string causes = listed(causes_of(found));
  std::vector<Section> sections;
  const Json& gap = found["gap"];
  // None: nothing can be simulated, or no flight was left to try it on.
  if (!gap.contains("horizons") || std::ranges::any_of(gap["horizons"], predicted)) {
    sections.push_back(how_section(found, causes));
    std::ranges::copy(evidence.held_out, std::back_inserter(sections.front().plots));
  }
  if (Section which = which_section(found); !which.tables.empty() || !which.plots.empty())
    sections.push_back(std::move(which));
  std::ranges::move(signature_sections(evidence.signatures), std::back_inserter(sections));
  sections.push_back(where_section(found, before, after));
  sections.push_back(tried_section(found));
  sections.push_back(traces(before, after));
  return sections;
}

}  // namespace ident
