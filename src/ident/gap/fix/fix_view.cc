// The table of changes, and one sentence on held-out flight.
#include "ident/gap/fix/fix_view.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/core/format_number.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

std::string after_text(const FileChange& change) {
  return change.std ? format_with_uncertainty(change.after, *change.std) : format_number(change.after, 6);
}

Json to_json(const FileChange& change) {
  return {{"name", change.name},   {"before", change.before ? Json(*change.before) : Json(nullptr)},
          {"after", change.after}, {"std", change.std ? Json(*change.std) : Json(nullptr)},
          {"unit", change.unit},   {"of", change.of}};
}

/// Empty where nothing was predicted.
std::string on_held_out_flight(const GapClosed& gap) {
  if (!std::isfinite(gap.before + gap.after + gap.floor)) return {};
  return fmt::format(
      "Half a second ahead on held-out flight, the file as given misses {} times the noise of the sensors, "
      "the model found {} times; no model misses less than {}.",
      format_number(gap.before, 3), format_number(gap.after, 3), format_number(gap.floor, 3));
}

}  // namespace

void enter_fix(Diagnosis& diagnosis, const FixedFile& fixed, const std::string& from, const std::string& to) {
  Result& result = diagnosis.result;
  Section section{.title = fmt::format("What changes in {}", from)};
  Table table{.title = section.title, .columns = {"entry", "in the file", "from these logs", "unit"}};
  Json changes = Json::array();
  for (const FileChange& change : fixed.changes) {
    table.rows.push_back({change.name, change.before ? format_number(*change.before, 6) : "–",
                          after_text(change), change.unit});
    changes.push_back(to_json(change));
  }
  const std::string predicted = on_held_out_flight(diagnosis.gap);
  section.text = fixed.changes.empty() ? "No value of this file was identified to be another one."
                                       : "Values that these logs do not tell stay as they were.";
  if (!predicted.empty()) section.text += " " + predicted;
  for (const std::string& lost : fixed.lost) {
    result.warn("left_out", fixed.format + ": " + lost);
    section.text += fmt::format(" Not in the file: {}.", lost);
  }
  section.tables.push_back(std::move(table));
  result.verdict += fmt::format(" {} value{} of {} changed, in {}.", fixed.changes.size(),
                                fixed.changes.size() == 1 ? "" : "s", from, to);
  if (!predicted.empty()) result.verdict += " " + predicted;
  result.extra["fix"] = std::move(changes);
  result.extra["lost"] = fixed.lost;
  result.extra["output"] = to;
  result.sections.insert(result.sections.begin(), std::move(section));
}

}  // namespace ident
