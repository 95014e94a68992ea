// The list of findings.def as data.
#include "ident/result/findings.h"

#include <algorithm>
#include <array>

namespace ident {
namespace {

constexpr FindingInfo kFindings[] = {
#define IDENT_FINDING(code, stage, seen, consequence, advice) \
  {#code, FindingStage::stage, seen, consequence, advice},
#include "ident/result/findings.def"
#undef IDENT_FINDING
};

static_assert(std::ranges::is_sorted(kFindings, {}, &FindingInfo::stage));

constexpr std::array kStageTitles = {"Reading a flight log",
                                     "Reading a table",
                                     "Vehicle, campaign and simulator files",
                                     "Thrust stand",
                                     "Motor steps",
                                     "Pendulum",
                                     "Slant angle",
                                     "Consistency of a vehicle file",
                                     "Flight: preparation",
                                     "Flight: self-test",
                                     "Flight: fit",
                                     "Flight: judgement of the fit",
                                     "Gap diagnosis",
                                     "Vehicle served to an autopilot"};

static_assert(kStageTitles.size() == static_cast<std::size_t>(FindingStage::fly) + 1);

}  // namespace

std::span<const FindingInfo> all_findings() { return kFindings; }

const FindingInfo* find_finding(std::string_view code) {
  const auto* const at = std::ranges::find(kFindings, code, &FindingInfo::code);
  return at == std::ranges::end(kFindings) ? nullptr : at;
}

std::string_view stage_title(FindingStage stage) { return kStageTitles[static_cast<std::size_t>(stage)]; }

}  // namespace ident
