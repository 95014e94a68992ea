// A stored result comes back as it was.
#include "ident/report/stored_result.h"

#include <gtest/gtest.h>

#include <limits>

#include "ident/report/html.h"
#include "ident/report/report.h"

namespace ident {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Result full_result() {
  Result r;
  r.command = "flightlog";
  r.inputs = {"a.csv", "b.csv"};
  r.parameters = {{.name = "kT",
                   .value = 0.1 + 0.2,
                   .std = 1e-17,
                   .ci95 = {-kInfinity, kInfinity},
                   .unit = "N s^2/rad^2",
                   .identifiable = false,
                   .source = "thrust",
                   .naive_std = 1.0 / 3,
                   .prior_value = kNaN,
                   .pull = -2.5,
                   .note = "why \"not\""},
                  {.name = "kT"}};
  r.fit = {{"samples", 812}, {"rmse", {{"thrust", 0.011}}}};
  r.warn("code", "text");
  r.extra = {{"alpha_opt", 0.1}, {"command", "overrides"}};
  r.verdict = "Verdict.";
  Plot plot{.id = "p", .title = "t", .x_label = "t [s]", .kind = Plot::Kind::time_series, .log_y = true};
  plot.series = {{.name = "p", .x = {0, 1, 2}, .y = {0, kNaN, 2}, .style = Series::Style::band}};
  plot.cells = Eigen::MatrixXd{{1, 2, 3}, {4, kNaN, 6}};
  plot.row_names = {"a", "b"};
  r.sections = {{.title = "s", .text = "x", .tables = {{"t", {"c"}, {{"1"}, {}}}}, .plots = {plot}}};
  r.correlation = {{"kT", "kQ"}, Eigen::MatrixXd{{1, 0.5}, {0.5, 1}}};
  r.prior_correlation = {{"kT", "km"}, Eigen::MatrixXd{{1, -0.9}, {-0.9, 1}}};
  r.files = {{"a.csv", "00ff"}};
  r.command_line = {"ident", "flightlog", "a b.csv"};
  r.seed = 18446744073709551615ULL;
  r.version = "0.0.9";
  return r;
}

TEST(StoredResult, ComesBackFieldByFieldThroughText) {
  const Result before = full_result();
  const auto stored = stored_json(before);
  const Result after = result_from_json(nlohmann::ordered_json::parse(stored.dump()));
  EXPECT_EQ(stored_json(after).dump(), stored.dump());
  // `stored_json` alone could forget a field on both ways; what users see must be the same too.
  EXPECT_EQ(to_json(after).dump(), to_json(before).dump());
  EXPECT_EQ(render_html(after), render_html(before));
  EXPECT_EQ(after.parameters[0].value, before.parameters[0].value);
  EXPECT_EQ(after.parameters[0].ci95, before.parameters[0].ci95);
  EXPECT_TRUE(std::isnan(*after.parameters[0].prior_value));
  EXPECT_EQ(after.sections[0].plots[0].cells(0, 2), 3);
  EXPECT_EQ(after.seed, before.seed);
}

TEST(StoredResult, RemembersTheVersionThatFoundIt) {
  EXPECT_FALSE(result_from_json(stored_json(Result{})).version.empty());
  EXPECT_EQ(result_from_json(stored_json(full_result())).version, "0.0.9");
}

TEST(StoredResult, RefusesOtherJson) {
  EXPECT_THROW(result_from_json(nlohmann::ordered_json::parse("{}")), nlohmann::json::exception);
  EXPECT_THROW(result_from_json(to_json(full_result())), nlohmann::json::exception);
}

}  // namespace
}  // namespace ident
