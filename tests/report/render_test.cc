// Every form of a report says the same, in the same order, and no name breaks out of its place.
#include <gtest/gtest.h>

#include "ident/report/report.h"

namespace ident {
namespace {

Result thrust_result() {
  Result result;
  result.command = "thrust";
  result.verdict = "kT is known to 0.2 %.";
  result.parameters = {
      {.name = "kT",
       .value = 6.0143e-6,
       .std = 1.2e-8,
       .ci95 = {5.9908e-6, 6.0378e-6},
       .unit = "N s^2/rad^2",
       .source = "thrust"},
      {.name = "zeta_m", .value = 1.0, .std = 0.8, .identifiable = false, .note = "only km/zeta_m is"}};
  result.warn("tare_offset", "Thrust at rest is 0.2 N: tare the stand.");
  result.sections = {{.title = "Data health", .text = "812 rows.", .tables = {}, .plots = {}}};
  return result;
}

void expect_in_order(const std::string& page, std::initializer_list<const char*> parts) {
  std::size_t at = 0;
  for (const char* part : parts) {
    const std::size_t found = page.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << " is missing or out of order in\n" << page;
    at = found;
  }
}

TEST(Report, GoesFromVerdictToProvenanceInHtmlAndMarkdown) {
  const Result result = thrust_result();
  expect_in_order(render_html(result), {"ident thrust", "kT is known to 0.2 %.", "Parameters", "6.014e-6",
                                        "Checks and warnings", "tare_offset", "Data health", "Provenance"});
  expect_in_order(render_markdown(result),
                  {"# ident thrust", "kT is known to 0.2 %.", "## Parameters", "6.014e-6",
                   "## Checks and warnings", "tare\\_offset", "## Data health", "## Provenance"});
}

TEST(Report, SaysInTheTerminalWhatIsNotIdentifiableAndWhy) {
  expect_in_order(render_text(thrust_result()), {"kT is known", "6.014e-6", "zeta_m ?",
                                                 "not identifiable: only km/zeta_m is", "tare_offset"});
}

TEST(Report, EscapesHostileNamesEverywhere) {
  const std::string hostile = "</script><img src=x onerror=\"alert('1')\">&";
  Result result = thrust_result();
  result.command = result.verdict = hostile;
  result.parameters[0].name = result.parameters[0].unit = result.parameters[0].source = hostile;
  result.parameters[1].note = hostile;
  result.warnings = {{hostile, hostile}};
  result.files = {{hostile, hostile}};
  result.command_line = {"ident", hostile};
  result.sections[0].title = result.sections[0].text = hostile;
  result.sections[0].tables = {{.title = hostile, .columns = {hostile}, .rows = {{hostile, hostile}}}};
  EXPECT_EQ(render_html(result).find("<img"), std::string::npos);
  EXPECT_EQ(render_markdown(result).find("<img"), std::string::npos);
}

}  // namespace
}  // namespace ident
