// Reports in a real browser: no errors, plots drawn, zoom, dark mode, phone, paper.
#include <array>
#include <cctype>

#include "ident/report/assets.h"
#include "ident/report/html.h"
#include "ident/report/report.h"
#include "support/report_in_browser.h"
#include "support/sample_results.h"

namespace ident::testing {
namespace {

std::string campaign_page() {
  const std::array results{sample_parameter_result(), sample_gap_result()};
  return render_html("falcon", results);
}

TEST_F(ReportInBrowser, OpensWithoutErrorsAndDrawsEveryTimeSeries) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  open(campaign_page());
  see_everything();
  EXPECT_TRUE(browser_->errors().empty()) << browser_->errors().front();
  EXPECT_EQ(value("document.querySelectorAll('.chart:not(.live)').length"), 0);
  const nlohmann::json colours = value(kColours);
  ASSERT_EQ(colours.size(), 2U);
  for (const auto& count : colours) EXPECT_GT(count, 20);
}

TEST_F(ReportInBrowser, ZoomsAllPlotsOfASectionTogetherAndBack) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  open(render_html(sample_parameter_result()));
  see_everything();
  const auto visible_resets = [&] {
    return value("document.querySelectorAll('.reset:not([hidden])').length");
  };
  EXPECT_EQ(visible_resets(), 0);
  value("document.querySelector('.chart').scrollIntoView({ block: 'center', behavior: 'instant' })");
  const nlohmann::json box = value("document.querySelector('.u-over').getBoundingClientRect().toJSON()");
  const double left = box.at("left"), width = box.at("width"), y = box.at("top").get<double>() + 60;
  const auto last_time = "document.querySelector('.u-legend .u-value').textContent";

  browser_->move_mouse(left + width - 3, y);
  wait_a_moment();
  EXPECT_NEAR(std::stod(value(last_time).get<std::string>()), 20, 0.2);
  EXPECT_NE(value("document.querySelectorAll('.u-legend')[1].querySelectorAll('.u-value')[4].textContent"),
            "--")
      << "the cursor is not shared";

  browser_->drag(left + 0.25 * width, left + 0.5 * width, y);
  wait_a_moment();
  EXPECT_EQ(visible_resets(), 2);
  browser_->move_mouse(left + width - 3, y);
  wait_a_moment();
  EXPECT_NEAR(std::stod(value(last_time).get<std::string>()), 10, 0.2);

  value("document.querySelectorAll('.reset')[1].click()");
  wait_a_moment();
  EXPECT_EQ(visible_resets(), 0);
  EXPECT_TRUE(browser_->errors().empty()) << browser_->errors().front();
}

TEST_F(ReportInBrowser, DrawsSixHundredThousandPointsWithinASecond) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  open(render_html(large_result()));
  see_everything();
  EXPECT_EQ(value("document.querySelectorAll('.chart.live').length"), 1);
  EXPECT_LT(browser_->busy_seconds(), 1.0)
      << "by the clock drawing took " << value("document.querySelector('.chart').dataset.milliseconds")
      << " ms";
}

TEST_F(ReportInBrowser, ShowsStaticPicturesWhereThePlotLibraryIsMissing) {
  std::string page = render_html(sample_parameter_result());
  if (const std::size_t at = page.find(kPlotLibrary); !kPlotLibrary.empty())
    page.erase(at, kPlotLibrary.size());
  open(page);
  see_everything();
  EXPECT_TRUE(browser_->errors().empty()) << browser_->errors().front();
  EXPECT_EQ(value("document.querySelectorAll('.chart.live, canvas').length"), 0);
  EXPECT_EQ(
      value("[...document.querySelectorAll('.picture svg')].filter((s) => !s.getClientRects().length || "
            "!s.querySelector('path, rect')).length"),
      0);
  EXPECT_GE(value("document.querySelectorAll('.picture svg').length"), 5);
}

TEST_F(ReportInBrowser, KeepsContrastInLightAndDark) {
  const std::string poor_contrast = script("poor_contrast.js");
  for (const bool dark : {false, true}) {
    browser_->set_window(1300, 900, dark);
    open(campaign_page());
    EXPECT_EQ(value(poor_contrast), nlohmann::json::array()) << (dark ? "dark" : "light");
    const auto background = "getComputedStyle(document.body).backgroundColor";
    const nlohmann::json before = value(background);
    value("document.getElementById('theme').click()");
    EXPECT_NE(value(background), before) << "the button does not switch";
    EXPECT_EQ(value(poor_contrast), nlohmann::json::array()) << (dark ? "light" : "dark") << " by the button";
    value("localStorage.clear()");
  }
}

TEST_F(ReportInBrowser, FitsAPhone) {
  browser_->set_window(390, 800);
  open(campaign_page());
  see_everything();
  EXPECT_LE(value("document.documentElement.scrollWidth"), 390);
  EXPECT_TRUE(browser_->errors().empty());
}

TEST_F(ReportInBrowser, RunsNoScriptThatComesFromAName) {
  const std::string hostile =
      "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>";
  Result result = sample_parameter_result();
  result.command = result.verdict = hostile;
  for (Section& section : result.sections)
    for (Plot& plot : section.plots) {
      plot.title = plot.caption = plot.x_label = plot.y_label = hostile;
      for (Series& series : plot.series) series.name = hostile;
    }
  open(render_html(result));
  see_everything();
  EXPECT_TRUE(value("window.hacked === undefined && document.images.length === 0").get<bool>());
  EXPECT_TRUE(browser_->errors().empty()) << browser_->errors().front();
}

TEST_F(ReportInBrowser, PrintsEverySectionOnA4) {
  if (!can_read_pdf()) GTEST_SKIP() << "poppler-utils is not installed (tests/run.sh installs it)";
  browser_->set_window(1300, 900, true);
  open(campaign_page());
  see_everything();
  const auto without_spaces = [](std::string words) {
    std::erase_if(words, [](unsigned char c) { return std::isspace(c) != 0; });
    return words;
  };
  const std::string text = without_spaces(printed_text());
  for (const char* part :
       {"falcon", "ident flightlog", "Parameters", "Identifiable", "Checks and warnings", "Data health",
        "Prediction", "Roll rate, second flight", "rate [rad/s]", "Spectrum of the residual",
        "Correlation of the estimates", "Provenance", "9f86d081884c", "ident gap", "How far the gap closes"})
    EXPECT_NE(text.find(without_spaces(part)), std::string::npos) << part << " is not on paper";
  EXPECT_EQ(text.find("Wholerecord"), std::string::npos) << "buttons are no use on paper";
}

}  // namespace
}  // namespace ident::testing
