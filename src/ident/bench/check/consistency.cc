// Runs the checks and puts their findings into a result.
#include "ident/bench/check/consistency.h"

#include <fmt/format.h>

#include "ident/bench/check/consistency_hover.h"
#include "ident/bench/check/consistency_inertia.h"
#include "ident/bench/check/consistency_motor.h"
#include "ident/bench/check/consistency_rotor.h"
#include "ident/bench/check/consistency_slant.h"
#include "ident/bench/check/consistency_values.h"

namespace ident {
namespace {

Table findings_table(const Consistency& found) {
  Table table{.title = "Checks", .columns = {"what", "verdict", "numbers"}};
  for (const Finding& finding : found.findings)
    table.rows.push_back({finding.what, finding.verdict, finding.numbers});
  return table;
}

std::string verdict(const Consistency& found) {
  if (found.violations.empty())
    return found.warnings.empty() ? "Nothing here contradicts physics."
                                  : "Nothing here contradicts physics, but some of it is doubtful.";
  std::string text = found.violations.size() == 1
                         ? "One statement is impossible:"
                         : fmt::format("{} statements are impossible:", found.violations.size());
  for (const Violation& violation : found.violations) text += " " + violation.message + ".";
  return text;
}

}  // namespace

void Consistency::ok(std::string what, std::string numbers) {
  findings.push_back({std::move(what), "ok", std::move(numbers)});
}

void Consistency::violated(std::string what, Violation violation) {
  findings.push_back({std::move(what), "violated", violation.message});
  violations.push_back(std::move(violation));
}

void Consistency::doubtful(std::string what, Warning warning) {
  findings.push_back({std::move(what), "doubtful", warning.message});
  warnings.push_back(std::move(warning));
}

void Consistency::cannot_be_judged(std::string what, const std::string& missing) {
  findings.push_back({std::move(what), "cannot be judged", "without " + missing});
}

Result check_consistency(const Vehicle& vehicle) {
  Consistency found;
  for (const char* key : {"thrust_to_weight", "hover_command", "hover_rotor_speed"})
    found.extra[key] = nullptr;
  check_values(vehicle, found);
  check_inertia(vehicle, found);
  check_hover(vehicle, found);
  check_rotor(vehicle, found);
  check_slant(vehicle, found);
  check_motor(vehicle, found);
  Result result{.command = "check", .inputs = {vehicle.file}, .warnings = vehicle.warnings};
  result.warnings.insert(result.warnings.end(), found.warnings.begin(), found.warnings.end());
  auto violations = nlohmann::ordered_json::array();
  for (const Violation& v : found.violations)
    violations.push_back({{"code", v.code}, {"message", v.message}, {"values", v.values}});
  result.extra["violations"] = violations;
  result.extra.update(found.extra);
  result.verdict = verdict(found);
  result.sections = {{.title = "Physical consistency",
                      .text = "A violation is what no real vehicle can be; a doubt is what few are.",
                      .tables = {findings_table(found)}}};
  return result;
}

}  // namespace ident
