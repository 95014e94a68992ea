// The reports of a refinement and of a diagnosis, made by the program from short simulated flights, in a real
// browser.
#include <algorithm>
#include <cctype>
#include <fstream>

#include "ident/result/result.h"
#include "support/report_in_browser.h"
#include "support/run_program.h"

namespace ident::testing {
namespace {

namespace fs = std::filesystem;

class FlightReportInBrowser : public ReportInBrowser {
 protected:
  void run(const std::vector<std::string>& arguments) {
    const ProgramRun done = run_ident(arguments, folder_.string());
    ASSERT_EQ(done.status, 0) << arguments.front() << ": " << done.err;
  }

  /// flight.csv: a vehicle with rotor drag, which model.yaml lacks.
  void fly() {
    const fs::path truth = fs::path(IDENT_SOURCE_DIR) / "data/sample_truth/falcon_truth.yaml";
    std::ifstream file(truth);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    write_text(folder_.string(), "drone.yaml", text + "\n  rotor_drag.kd: 8.0e-5\n");
    fs::copy(fs::path(IDENT_SOURCE_DIR) / "data/sample/falcon.yaml", folder_ / "model.yaml");
    run({"simulate", "flight", "--vehicle", "drone.yaml", "--scenario", "mixed", "--duration", "14", "--rate",
         "100", "--output", "flight.csv"});
  }

  /// Dark, scrolled through: no errors, no empty plot, enough contrast in both schemes.
  void expect_alive(const std::string& page) {
    const std::string poor_contrast = script("poor_contrast.js");
    for (const bool dark : {false, true}) {
      browser_->set_window(1300, 900, dark);
      open_file(folder_ / page);
      see_everything();
      EXPECT_TRUE(browser_->errors().empty()) << browser_->errors().front();
      EXPECT_EQ(value(poor_contrast), nlohmann::json::array()) << (dark ? "dark" : "light");
    }
    EXPECT_EQ(value("document.querySelectorAll('.chart:not(.live)').length"), 0);
    const nlohmann::json colours = value(kColours);
    EXPECT_GT(colours.size(), 3U);
    for (const auto& count : colours) EXPECT_GT(count, 5) << "an empty plot";
    EXPECT_EQ(value("[...document.querySelectorAll('.picture svg')].filter((s) => !s.querySelector('path, "
                    "rect')).length"),
              0);
  }

  void expect_on_paper(const std::vector<std::string>& sections) {
    const auto letters = [](const std::string& text) {
      std::string out;
      std::ranges::copy_if(text, std::back_inserter(out),
                           [](unsigned char c) { return std::isalnum(c) != 0; });
      return out;
    };
    const nlohmann::json found =
        value("[...document.querySelectorAll('h1, h2, h3, figcaption strong')].map((h) => h.textContent)");
    const std::vector<std::string> headings = found;
    for (const std::string& section : sections)
      EXPECT_TRUE(std::ranges::count(headings, section) > 0) << section << " is not in the report";
    if (!can_read_pdf()) GTEST_SKIP() << "poppler-utils is not installed (tests/run.sh installs it)";
    const std::string paper = letters(printed_text());
    for (const std::string& heading : headings)
      EXPECT_NE(paper.find(letters(heading)), std::string::npos) << heading << " is not on paper";
  }
};

TEST_F(FlightReportInBrowser, DiagnosisShowsSignatureAndHeldOutTracesInLightDarkAndPrint) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  fly();
  run({"gap", "flight.csv", "--vehicle", "model.yaml", "--report", "gap.html"});
  expect_alive("gap.html");
  expect_zoom();
  expect_on_paper({"How far the gap closes", "Prediction error over 0.5 s on held-out flight", "Which causes",
                   "The signature against the flight", "Where the gap lies", "What was tried",
                   "The residual over time", "Data health", "Parameters", "Provenance"});
  EXPECT_GE(
      value("[...document.querySelectorAll('figcaption strong')].filter((c) => c.textContent.startsWith("
            "'Signature of rotor_drag')).length"),
      1);
  EXPECT_GE(value("[...document.querySelectorAll('figcaption strong')].filter((c) => c.textContent.includes("
                  "'predicted 1 s ahead')).length"),
            1);
}

TEST_F(FlightReportInBrowser, RefinementShowsResidualsProfilesAndHeldOutTracesInLightDarkAndPrint) {
  if (!has_interactive_plots()) GTEST_SKIP() << "uPlot is not there (npm ci in src/ident/report)";
  fly();
  run({"flightlog", "flight.csv", "--vehicle", "model.yaml", "--refine", "--report", "refine.html"});
  expect_alive("refine.html");
  expect_zoom();
  expect_on_paper({"Parameters", "Checks and warnings", "Data health", "Residuals of the fit",
                   "Residuals over time: body rates", "Distribution: specific force",
                   "Against the normal distribution: velocity", "Autocorrelation: position",
                   "Spectrum: attitude", "Accelerations from outside",
                   "Profile likelihood of weak parameters", "Held-out prediction",
                   "Simulated against measured", "Correlation", "Provenance"});
}

}  // namespace
}  // namespace ident::testing
