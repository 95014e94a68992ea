// A test with a report in a real browser: opens it, scrolls through it, reads what it prints.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "support/browser.h"

namespace ident::testing {

class ReportInBrowser : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  void open(const std::string& html);
  void open_file(const std::filesystem::path& page);
  nlohmann::json value(const std::string& expression) { return browser_->evaluate(expression); }

  /// Scrolls through the page, so that every plot comes into view, then back to the top.
  void see_everything();
  /// Drags over the first chart: it zooms.
  void expect_zoom();
  void wait_a_moment() { value("new Promise((done) => setTimeout(done, 150))"); }

  /// What stands on the paper when the page is printed.
  std::string printed_text();
  static bool can_read_pdf();
  /// Without npm at set-up reports have static plots only.
  static bool has_interactive_plots();

  /// A script of tests/report.
  static std::string script(const std::string& name);

  std::filesystem::path folder_;
  std::unique_ptr<Browser> browser_;
};

/// JavaScript: how many colours each canvas shows, 1 for an empty one.
extern const char* const kColours;

}  // namespace ident::testing
