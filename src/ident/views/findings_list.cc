// Groups the findings by stage, for the terminal, for JSON and for the guide.
#include "ident/views/findings_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "ident/result/findings.h"

namespace ident {
namespace {

constexpr std::size_t kMostRows = 20;  // of a table: the terminal shortens tables of more than 24

std::string cell_text(const FindingInfo& finding) {
  return fmt::format("{} {} {}", finding.seen, finding.consequence, finding.advice);
}

Section stage_section(std::span<const FindingInfo> findings) {
  const std::string title(stage_title(findings.front().stage));
  Section section{.title = title};
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (i % kMostRows == 0)
      section.tables.push_back(
          {title + (i == 0 ? "" : ", continued"), {"Code", "Seen, consequence, what to do"}, {}});
    section.tables.back().rows.push_back({std::string(findings[i].code), cell_text(findings[i])});
  }
  return section;
}

/// The findings of each stage, in the order of the list.
std::vector<std::span<const FindingInfo>> by_stage() {
  std::vector<std::span<const FindingInfo>> stages;
  for (std::span<const FindingInfo> rest = all_findings(); !rest.empty();) {
    const auto next = std::ranges::find_if(
        rest, [&](const FindingInfo& finding) { return finding.stage != rest.front().stage; });
    stages.push_back(rest.first(static_cast<std::size_t>(next - rest.begin())));
    rest = rest.subspan(stages.back().size());
  }
  return stages;
}

}  // namespace

Result findings_list() {
  Result result{.command = "check"};
  auto list = nlohmann::ordered_json::array();
  for (const FindingInfo& finding : all_findings())
    list.push_back({{"code", finding.code},
                    {"stage", stage_title(finding.stage)},
                    {"seen", finding.seen},
                    {"consequence", finding.consequence},
                    {"advice", finding.advice}});
  result.extra["findings"] = std::move(list);
  for (const std::span<const FindingInfo> findings : by_stage())
    result.sections.push_back(stage_section(findings));
  result.verdict =
      fmt::format("The {} codes of findings, by the stage that issues them.", all_findings().size());
  return result;
}

std::string findings_page() {
  std::string page =
      "# Warnings\n\n"
      "Every code that `ident` prints as a warning, as a violation of `ident check`, or as a finding in "
      "JSON.\n"
      "Each has three parts: what was seen, what it does to the result, and what you can do.\n"
      "A constant that is *not identifiable* is printed, but is not stored by itself; see the\n"
      "[user guide](user_guide.md#reading-a-report-of-a-refinement).\n"
      "Thresholds stand with the name of their constant and its file below `src/ident`.\n\n"
      "`ident check --list` prints the same list, `ident check --list --json` as JSON.\n"
      "This page is written by `ident check --list --markdown notebooks/guide/warnings.md`; a test compares "
      "the two.\n";
  for (const std::span<const FindingInfo> findings : by_stage()) {
    page += fmt::format("\n## {}\n", stage_title(findings.front().stage));
    for (const FindingInfo& finding : findings)
      page += fmt::format("\n### {}\n\n* Seen: {}\n* Consequence: {}\n* What to do: {}\n", finding.code,
                          finding.seen, finding.consequence, finding.advice);
  }
  return page;
}

}  // namespace ident
