// What every form of a report has in common: verdict, order, findings by kind, digest of the fit.
#include "ident/report/blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ident {
namespace {

Parameter known(const char* name, double value, double std, const char* unit) {
  return {.name = name, .value = value, .std = std, .unit = unit, .source = "motor"};
}

TEST(ReportBlocks, SayWhatWasIdentifiedWhereTheCommandHasNoVerdict) {
  Result result;
  result.parameters = {known("km", 789.75, 0.11, "rad/s"),
                       known("zeta_m", 0.8495, 0.0023, "-"),
                       {.name = "Jp", .value = 1, .std = 9, .unit = "kg m^2", .identifiable = false}};
  EXPECT_EQ(verdict_of(result), "km = 789.75 ± 0.11 rad/s, zeta_m = 0.8495 ± 0.0023.");
  result.warn("outliers", "3 rows");
  result.warn("outliers", "1 row");
  result.warn("tare", "0.2 N");
  EXPECT_EQ(verdict_of(result),
            "km = 789.75 ± 0.11 rad/s, zeta_m = 0.8495 ± 0.0023. To look at: outliers, tare.");
}

TEST(ReportBlocks, GatherFindingsOfOneKind) {
  Result result;
  for (const char* code : {"a", "b", "a"}) result.warn(code, code);
  const std::vector<Findings> kinds = findings_by_kind(result);
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[0].code, "a");
  EXPECT_EQ(kinds[0].messages.size(), 2U);
}

TEST(ReportBlocks, PutDataHealthFirstThenTheFitThenThePictures) {
  Result result;
  result.fit = {{"samples", 12}};
  result.sections = {{.title = "Held-out prediction"}, {.title = "Data health", .text = "250 Hz"}};
  const std::vector<Section> parts = sections_in_order(result);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].text, "250 Hz");
  EXPECT_EQ(parts[1].title, "Fit");
  EXPECT_EQ(parts[2].title, "Held-out prediction");
}

TEST(ReportBlocks, TellHowFilesWereReadWhereTheCommandDoesNot) {
  Result result;
  result.extra["notices"] = {"a.csv: separator comma", "b.csv: decimal comma"};
  const std::vector<Section> parts = sections_in_order(result);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].title, "Data health");
  EXPECT_EQ(lines_of(parts[0].text),
            (std::vector<std::string>{"a.csv: separator comma", "b.csv: decimal comma"}));
}

TEST(ReportBlocks, LeaveOutOfTheDigestWhatIsDeepOrMany) {
  Result result;
  result.fit["r2"] = 0.5;
  result.fit["rmse"] = {{"thrust", 0.25}};
  result.fit["channels"] = {{"p", {{"rms", 1.0}}}};
  result.fit["held_out"] = nlohmann::ordered_json::array({{{"horizon", 0.1}}});
  for (int i = 0; i < 20; ++i) result.fit["noise"]["c" + std::to_string(i)] = 0.5;
  const Table digest = fit_table(result);
  ASSERT_EQ(digest.rows.size(), 2U);
  EXPECT_EQ(digest.rows[0], (std::vector<std::string>{"r2", "0.5"}));
  EXPECT_EQ(digest.rows[1], (std::vector<std::string>{"rmse.thrust", "0.25"}));
}

TEST(ReportBlocks, NameTheReasonOnceForAllParametersThatShareIt) {
  Result result;
  result.parameters = {{.name = "kT", .identifiable = false, .note = "too short"},
                       {.name = "Jp", .identifiable = false, .note = "never turned"},
                       {.name = "kQ", .identifiable = false, .note = "too short"}};
  EXPECT_EQ(not_identifiable(result), (std::vector<std::string>{"kT, kQ are not identifiable: too short",
                                                                "Jp is not identifiable: never turned"}));
}

TEST(ReportBlocks, ShowTheSourceOnlyWhereItDiffers) {
  Result result;
  result.parameters = {known("km", 1, 0.1, "rad/s"), known("zeta_m", 1, 0.1, "-")};
  const auto sources = [&] { return std::ranges::count(parameter_table(result).columns, "Source"); };
  EXPECT_EQ(sources(), 0);
  result.parameters[1].source = "flightlog";
  EXPECT_EQ(sources(), 1);
}

TEST(ReportBlocks, WriteTheCommandWithoutTheFolderOfTheProgram) {
  Result result;
  result.command_line = {"/usr/local/bin/ident", "thrust", "my sweep.csv"};
  EXPECT_EQ(command_line_of(result), "ident thrust 'my sweep.csv'");
}

}  // namespace
}  // namespace ident
