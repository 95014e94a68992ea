// Every report that a user of data/sample makes within seconds, in a real browser; those of a refinement and
// a diagnosis are in browser_flight_test.cc.
#include <algorithm>
#include <array>
#include <cctype>

#include "ident/result/result.h"
#include "support/report_in_browser.h"
#include "support/run_program.h"

namespace ident::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::array kCommands{"thrust", "motor", "inertia", "slant", "check", "flightlog"};

class CampaignInBrowser : public ReportInBrowser {
 protected:
  /// Runs the campaign in a copy of data/sample; each command leaves its report beside the data.
  void run_campaign() {
    fs::copy(fs::path(IDENT_SOURCE_DIR) / "data/sample", folder_, fs::copy_options::recursive);
    for (const std::string command : kCommands) run({command, "--report", command + ".html"});
    run({"report", "--output", "report.html"});
  }

  void run(const std::vector<std::string>& arguments) {
    const ProgramRun done = run_ident(arguments, folder_.string());
    ASSERT_EQ(done.status, 0) << arguments.front() << ": " << done.err;
  }

  void expect_alive(const std::string& name) {
    see_everything();
    EXPECT_TRUE(browser_->errors().empty()) << name << ": " << browser_->errors().front();
    EXPECT_EQ(value("document.querySelectorAll('.chart:not(.live)').length"), 0) << name;
    for (const auto& count : value(kColours)) EXPECT_GT(count, 5) << name << " has an empty plot";
    EXPECT_EQ(value("[...document.querySelectorAll('.picture svg')].filter((s) => !s.querySelector('path, "
                    "rect')).length"),
              0)
        << name;
  }
};

std::string letters(const std::string& text) {
  std::string out;
  std::ranges::copy_if(text, std::back_inserter(out), [](unsigned char c) { return std::isalnum(c) != 0; });
  return out;
}

TEST_F(CampaignInBrowser, OpensEveryReportWithoutErrorsAndWithoutEmptyPlots) {
  run_campaign();
  for (const std::string command : kCommands) {
    open_file(folder_ / (command + ".html"));
    expect_alive(command);
  }
}

TEST_F(CampaignInBrowser, ShowsTheWholeCampaignInLightAndDarkZoomsAndPrintsEverySection) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  run_campaign();
  browser_->set_window(1300, 900, true);
  open_file(folder_ / "report.html");
  expect_alive("report");
  EXPECT_EQ(value(script("poor_contrast.js")), nlohmann::json::array());

  expect_zoom();

  if (!can_read_pdf()) GTEST_SKIP() << "poppler-utils is not installed (tests/run.sh installs it)";
  const std::string paper = letters(printed_text());
  const nlohmann::json headings =
      value("[...document.querySelectorAll('h1, h2, h3, figcaption strong')].map((h) => h.textContent)");
  ASSERT_GT(headings.size(), 40U);
  for (const std::string heading : headings)
    EXPECT_NE(paper.find(letters(heading)), std::string::npos) << heading << " is not on paper";
}

}  // namespace
}  // namespace ident::testing
