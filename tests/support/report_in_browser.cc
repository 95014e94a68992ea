// Drives the browser for tests of reports.
#include "support/report_in_browser.h"

#include <array>
#include <cstdio>
#include <fstream>

namespace ident::testing {

namespace fs = std::filesystem;

const char* const kColours = R"((() => [...document.querySelectorAll("canvas")].map((canvas) => {
  const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  const seen = new Set();
  for (let i = 0; i < pixels.length; i += 4) seen.add(pixels.slice(i, i + 4).join());
  return seen.size;
}))())";

void ReportInBrowser::SetUp() {
  if (!Browser::available()) GTEST_SKIP() << "chromium is not installed (tests/run.sh installs it)";
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::path(::testing::TempDir()) /
            (std::string("ident-report-") + test->test_suite_name() + "-" + test->name());
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  browser_ = std::make_unique<Browser>();
}

bool ReportInBrowser::has_interactive_plots() {
  return fs::exists(fs::path(IDENT_SOURCE_DIR) /
                    "src/ident/report/node_modules/uplot/dist/uPlot.iife.min.js");
}

void ReportInBrowser::TearDown() { fs::remove_all(folder_); }

void ReportInBrowser::open(const std::string& html) {
  const fs::path page = folder_ / "page.html";
  std::ofstream(page, std::ios::binary) << html;
  open_file(page);
}

void ReportInBrowser::expect_zoom() {
  value("document.querySelector('.chart').scrollIntoView({ block: 'center', behavior: 'instant' })");
  const nlohmann::json box =
      value("document.querySelector('.chart .u-over').getBoundingClientRect().toJSON()");
  const double left = box.at("left"), width = box.at("width"), y = box.at("top").get<double>() + 60;
  browser_->drag(left + 0.25 * width, left + 0.5 * width, y);
  wait_a_moment();
  EXPECT_GE(value("document.querySelectorAll('.reset:not([hidden])').length"), 1) << "no zoom";
}

void ReportInBrowser::open_file(const fs::path& page) { browser_->open(page); }

void ReportInBrowser::see_everything() {
  value(R"((async () => {
    const pause = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 40)));
    for (let y = 0; y <= document.body.scrollHeight; y += 1200) {
      scrollTo({ top: y, behavior: "instant" });
      await pause();
    }
    scrollTo({ top: 0, behavior: "instant" });
    await pause();
  })())");
}

std::string ReportInBrowser::script(const std::string& name) {
  std::ifstream file(fs::path(IDENT_SOURCE_DIR) / "tests/report" / name);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool ReportInBrowser::can_read_pdf() { return fs::exists("/usr/bin/pdftotext"); }

std::string ReportInBrowser::printed_text() {
  const fs::path pdf = folder_ / "page.pdf";
  std::ofstream(pdf, std::ios::binary) << browser_->print();
  const std::string command = "pdftotext -raw '" + pdf.string() + "' -";
  std::string text;
  std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe.get())) > 0;)
    text.append(chunk.data(), n);
  return text;
}

}  // namespace ident::testing
