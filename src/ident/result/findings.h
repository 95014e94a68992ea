// What each code of a finding means: the one list behind `ident check --list` and the guide's page of
// warnings.
#pragma once

#include <span>
#include <string_view>

namespace ident {

/// Where in the work a code comes up; the order is that of the list.
enum class FindingStage {
  log,
  table,
  vehicle,
  thrust,
  motor,
  inertia,
  slant,
  check,
  preparation,
  self_test,
  fit,
  judgement,
  gap,
  fly
};

/// A code in three texts of whole sentences.
struct FindingInfo {
  std::string_view code;
  FindingStage stage;
  std::string_view seen;  ///< what was seen, by which statistic, with its threshold and where that stands
  std::string_view consequence;  ///< what it does to the result
  std::string_view advice;       ///< what the user can do
};

/// All of `findings.def`, sorted by stage.
std::span<const FindingInfo> all_findings();

/// Null for a code that is not in the list.
const FindingInfo* find_finding(std::string_view code);

/// A stage as a heading: "Thrust stand".
std::string_view stage_title(FindingStage stage);

}  // namespace ident
