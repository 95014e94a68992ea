// Every form of a report says the same, in the same order, and no name breaks out of its place.
#include <gtest/gtest.h>

#include <sstream>

#include "ident/core/error.h"
#include "ident/report/html.h"
#include "ident/report/markdown.h"
#include "ident/report/report.h"
#include "ident/report/report_files.h"
#include "ident/report/text.h"

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

TEST(Report, ShowsItsPicturesInMarkdownFromAFolderBesideIt) {
  Result result = thrust_result();
  Plot plot{.id = "fit", .title = "Thrust over speed"};
  plot.series = {{.name = "thrust", .x = {0, 1}, .y = {0, 1}}};
  result.sections[0].plots = {plot, plot};
  const std::vector<ReportFile> files = report_files("out/falcon.md", result);
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].path, "out/falcon.md");
  EXPECT_NE(files[0].content.find("](<falcon_figures/thrust-fit.svg>)"), std::string::npos);
  EXPECT_EQ(files[1].path, "out/falcon_figures/thrust-fit.svg");
  EXPECT_EQ(files[2].path, "out/falcon_figures/thrust-fit-2.svg");
}

TEST(Report, IsInJsonWhatTheCommandPrintsWithTheSections) {
  const nlohmann::json json = nlohmann::json::parse(report_files("r.json", thrust_result()).at(0).content);
  EXPECT_EQ(json.at("schema"), "ident.result/1");
  EXPECT_EQ(json.at("sections").at(0).at("title"), "Data health");
}

TEST(Report, RefusesAnEndingThatItDoesNotKnow) { EXPECT_THROW(report_form("report.pdf"), UsageError); }

TEST(Report, AlignsNumbersOnThePointWithinEightyColumns) {
  Result result;
  result.parameters = {{.name = "a", .value = 947.21, .std = 3.1, .ci95 = {941.1, 953.3}, .unit = "rad/s"},
                       {.name = "b", .value = 0.0123, .std = 0.0011, .ci95 = {0.0101, 0.0145}, .unit = "s"}};
  result.verdict = std::string(50, 'x') + " " + std::string(50, 'y');
  std::istringstream lines(render_text(result));
  std::vector<std::size_t> points;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 80U) << line;
    if (line.starts_with("a ") || line.starts_with("b ")) points.push_back(line.find('.'));
  }
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0], points[1]);
}

}  // namespace
}  // namespace ident
