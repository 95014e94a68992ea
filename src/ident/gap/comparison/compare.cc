// Two diagnoses, two fits with the causes of both, and the verdict on their difference.
#include "ident/gap/comparison/compare.h"

#include <algorithm>

#include "ident/core/error.h"
#include "ident/gap/comparison/comparison_views.h"
#include "ident/gap/comparison/judged_difference.h"
#include "ident/gap/hypotheses/candidates.h"
#include "ident/gap/hypotheses/next_model.h"
#include "ident/gap/views/verdict_json.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

// Progress of one part as a share of the whole.
GapOptions part_of(const GapOptions& options, double from, double to) {
  GapOptions part = options;
  if (options.progress)
    part.progress = [=, told = options.progress](double share, const std::string& tried) {
      told(from + (to - from) * share, tried);
    };
  return part;
}

std::vector<Candidate> of_both(std::vector<Candidate> causes, const std::vector<Candidate>& others) {
  for (const Candidate& other : others)
    if (std::ranges::none_of(causes, [&](const Candidate& c) { return same(c, other); }))
      causes.push_back(other);
  return causes;
}

Json side_json(const Result& side) {
  return {{"inputs", side.inputs},
          {"verdict", side.extra.at("verdict")},
          {"candidates", side.extra.at("candidates")},
          {"gap", side.extra.at("gap")}};
}

// Findings of both logs, each once.
void tell_findings(Result& result, const Result& side) {
  result.inputs.insert(result.inputs.end(), side.inputs.begin(), side.inputs.end());
  for (const Warning& warning : side.warnings)
    if (std::ranges::none_of(result.warnings, [&](const Warning& w) { return w.message == warning.message; }))
      result.warnings.push_back(warning);
}

}  // namespace

Result compare_flights(const Vehicle& stated, std::span<const FlightLog> real,
                       std::span<const FlightLog> simulated, const GapOptions& options) {
  const Vehicle vehicle = with_doubted_effects(stated);  // as either diagnosis has it
  const Diagnosis flown = diagnose_gap(vehicle, real, part_of(options, 0.0, 0.4)),
                  computed = diagnose_gap(vehicle, simulated, part_of(options, 0.4, 0.8));
  const std::vector<Candidate> causes =
      of_both(named_causes(flown, vehicle), named_causes(computed, vehicle));
  if (options.progress) options.progress(0.8, "both logs with the same causes");
  const ComparedFit a = compared_fit(vehicle, real, causes), b = compared_fit(vehicle, simulated, causes);
  ComparisonRules rules{material_causes(flown), !has_rest(flown) && !has_rest(computed)};
  rules.material.merge(material_causes(computed));
  const std::vector<ComparedCause> compared = differences(a, b, rules);
  Sides sides{flown, computed, a.not_shown};
  for (const std::string& name : b.not_shown)
    if (std::ranges::find(sides.not_shown, name) == sides.not_shown.end()) sides.not_shown.push_back(name);
  const Judged verdict = judged_difference(sides, compared);

  Result result;
  result.schema = "ident.gap/1";
  result.command = "gap";
  tell_findings(result, flown.result);
  tell_findings(result, computed.result);
  for (const std::string& name : sides.not_shown)
    result.warn("not_comparable", name +
                                      " is named in one log, and the other one cannot show it: give both "
                                      "the same signals");
  result.verdict = verdict.sentence;
  result.extra["verdict"] = to_json(verdict);
  result.extra["differences"] = differences_json(compared, false);
  result.extra["compared"] = differences_json(compared, true);
  result.extra["real"] = side_json(flown.result);
  result.extra["simulated"] = side_json(computed.result);
  result.sections.push_back(comparison_section(compared));
  return result;
}

}  // namespace ident
