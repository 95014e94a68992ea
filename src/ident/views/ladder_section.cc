// Names, units and words of the ladder.
#include "ident/views/ladder_section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "ident/core/format_number.h"
#include "ident/effects/all_parameters.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 57.29577951308232;

struct MetricText {
  const char *key, *name, *unit;
  double scale;
};
constexpr std::array<MetricText, kMetrics> kTexts{{
    {"velocity", "velocity, attitude as measured", "m/s", 1.0},
    {"rate", "rates, velocity as measured", "rad/s", 1.0},
    {"attitude", "attitude, velocity as measured", "deg", kDegrees},
    {"open_velocity", "velocity, open loop", "m/s", 1.0},
    {"open_attitude", "attitude, open loop", "deg", kDegrees},
    {"rotor_speed", "rotor speeds for commands", "rad/s", 1.0},
}};

const MetricText& text_of(Metric metric) { return kTexts[static_cast<std::size_t>(metric)]; }

const char* key_of(Rung rung) {
  static constexpr std::array keys{"stated", "motors", "thrust", "drag",    "battery", "ground",
                                   "air",    "curve",  "trim",   "inertia", "full"};
  static_assert(keys.size() == static_cast<std::size_t>(Rung::full) + 1);
  return keys[static_cast<std::size_t>(rung)];
}

std::vector<std::string> row_of(const std::string& name, const ErrorTable& table, std::size_t metric) {
  std::vector<std::string> row{name};
  for (const double e : table[metric]) row.push_back(format_number(kTexts[metric].scale * e, 3));
  return row;
}

Json errors_json(const ErrorTable& table) {
  Json out = Json::object();
  for (std::size_t m = 0; m < kMetrics; ++m) {
    Json row = Json::array();
    for (const double e : table[m]) row.push_back(number_or_null(kTexts[m].scale * e));
    out[kTexts[m].key] = row;
  }
  return out;
}

Json json_of(const RungResult& rung) {
  Json j{{"rung", key_of(rung.rung)},
         {"errors", errors_json(rung.error)},
         {"kept", rung.refusal == Refusal::none}};
  if (const std::string why = refusal_in_words(rung); !why.empty()) j["why_not"] = why;
  Json constants = Json::object();
  for (const RungConstant& c : rung.constants)
    constants[c.name] = {
        {"value", number_or_null(c.value)}, {"std", number_or_null(c.std)}, {"unit", parameter_unit(c.name)}};
  j["parameters"] = constants;
  return j;
}

}  // namespace

std::string rung_name(Rung rung) {
  static constexpr std::array names{"as stated",
                                    "with motors",
                                    "with thrust",
                                    "with drag of rotors",
                                    "with battery",
                                    "with ground",
                                    "with inflow, lift and drag of the body",
                                    "with thrust by a curve",
                                    "with lasting moments",
                                    "with inertia and rotor torque",
                                    "full refinement"};
  static_assert(names.size() == static_cast<std::size_t>(Rung::full) + 1);
  return names[static_cast<std::size_t>(rung)];
}

std::string refusal_in_words(const RungResult& rung) {
  if (rung.refusal == Refusal::beyond)
    return fmt::format("asks for {} beyond what such a vehicle has", fmt::join(rung.beyond, ", "));
  if (rung.refusal == Refusal::unexplained)
    return "does not explain how the vehicle turned by what was logged of its rotors";
  if (rung.refusal == Refusal::worse)
    return fmt::format("predicts {} after {} s worse than the model {}", text_of(rung.metric).name,
                       format_number(kLadderHorizons[rung.horizon]), rung_name(rung.than));
  return {};
}

Section ladder_section(const LadderResult& ladder) {
  const RungResult& chosen = ladder.rungs[ladder.chosen];
  Section section{.title = "Ladder of models",
                  .text = fmt::format("Each model is fitted to the first 70 % of each log and predicts the "
                                      "rest, {:.0f} s. Taken is the highest that is in no error worse than a "
                                      "lower one beyond chance: {}.",
                                      ladder.seconds,
                                      chosen.rung == Rung::full ? "the full refinement"
                                                                : "the model " + rung_name(chosen.rung))};
  if (ladder.moments_unexplained)
    section.text += fmt::format(
        " No model predicts rates much better than no model at all: what was logged of the rotors does not "
        "explain how the vehicle turned, and its inertia stays open.{} {}",
        ladder.misses_turning ? " The full refinement was not tried for that." : "",
        ladder.rotor_speeds ? "Other arms, hub moments or spins than those stated may be behind it."
                            : "Rotor speeds, or commands at the rate at which they are sent, would tell.");
  for (std::size_t m = 0; m < kMetrics; ++m) {
    if (!std::isfinite(ladder.persistence[m][0])) continue;
    Table table{fmt::format("Error of {}, {}", kTexts[m].name, kTexts[m].unit), {"model"}, {}};
    for (const double h : kLadderHorizons) table.columns.push_back(format_number(h) + " s");
    for (const RungResult& rung : ladder.rungs)
      table.rows.push_back(row_of(rung_name(rung.rung), rung.error, m));
    table.rows.push_back(row_of("none: as it was", ladder.persistence, m));
    section.tables.push_back(std::move(table));
  }
  Table table{"Rungs", {"model", "taken up", "estimates"}, {}};
  for (const RungResult& rung : ladder.rungs) {
    std::vector<std::string> estimates;
    for (const RungConstant& c : rung.constants)
      estimates.push_back(fmt::format("{} {}", c.name, format_with_uncertainty(c.value, c.std)));
    const std::string why = refusal_in_words(rung);
    table.rows.push_back({rung_name(rung.rung), why.empty() ? "yes" : "no: it " + why,
                          fmt::format("{}", fmt::join(estimates, ", "))});
  }
  section.tables.push_back(std::move(table));
  return section;
}

nlohmann::ordered_json as_json(const LadderResult& ladder) {
  Json rungs = Json::array();
  for (const RungResult& rung : ladder.rungs) rungs.push_back(json_of(rung));
  return {{"chosen", key_of(ladder.rungs[ladder.chosen].rung)},
          {"held_out_seconds", ladder.seconds},
          {"horizons", kLadderHorizons},
          {"units",
           {{"velocity", "m/s"},
            {"rate", "rad/s"},
            {"attitude", "deg"},
            {"open_velocity", "m/s"},
            {"open_attitude", "deg"},
            {"rotor_speed", "rad/s"}}},
          {"no_model", errors_json(ladder.persistence)},
          {"moments_unexplained", ladder.moments_unexplained},
          {"rungs", rungs}};
}

}  // namespace ident
