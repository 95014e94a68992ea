// The tour of README: its quick commands run on data/sample, and print what README shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

struct Step {
  std::string command;
  std::vector<std::string> shown;
};

/// Commands of the console blocks with the lines under them.
std::vector<Step> tour() {
  std::ifstream readme(fs::path(IDENT_SOURCE_DIR) / "README.md");
  std::vector<Step> steps;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside && line.starts_with("$ ")) {
      steps.push_back({line.substr(2), {}});
    } else if (inside && line != "..." && !line.empty()) {
      steps.back().shown.push_back(line);
    }
  }
  return steps;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Equal words; a number may differ by 5 %, so that a better estimator needs no new README.
bool alike(const std::string& a, const std::string& b) {
  const auto digits = [](const std::string& w) { return w.find_first_of("0123456789"); };
  if (a == b) return true;
  if (digits(a) == std::string::npos || digits(a) != digits(b)) return false;
  const double x = std::strtod(a.c_str() + digits(a), nullptr),
               y = std::strtod(b.c_str() + digits(b), nullptr);
  return std::abs(x - y) <= 0.05 * std::max(std::abs(x), std::abs(y));
}

bool printed(const std::string& output, const std::string& line) {
  std::istringstream lines(output);
  for (std::string candidate; std::getline(lines, candidate);)
    if (std::ranges::equal(words(candidate), words(line), alike)) return true;
  return false;
}

TEST(Readme, ShowsWhatItsTourPrints) {
  const fs::path folder = fs::path(test_folder()) / "falcon";
  fs::remove_all(folder);
  fs::copy(fs::path(IDENT_SOURCE_DIR) / "data/sample", folder, fs::copy_options::recursive);
  int checked = 0;
  for (const Step& step : tour()) {
    std::vector<std::string> arguments = words(step.command);
    if (step.shown.empty()) continue;  // preparations, and what takes half a minute
    ASSERT_EQ(arguments.front(), "ident");
    arguments.erase(arguments.begin());
    const ProgramRun run = run_ident(arguments, folder.string());
    EXPECT_EQ(run.status, 0) << step.command << run.err;
    for (const std::string& line : step.shown)
      EXPECT_TRUE(printed(run.out, line)) << step.command << " does not print\n"
                                          << line << "\nbut\n"
                                          << run.out;
    ++checked;
  }
  EXPECT_GE(checked, 4);
}

TEST(Readme, LinksToFilesThatAreThere) {
  std::ifstream readme(fs::path(IDENT_SOURCE_DIR) / "README.md");
  const std::string text{std::istreambuf_iterator<char>(readme), {}};
  int links = 0;
  for (std::size_t at = 0; (at = text.find("](", at)) != std::string::npos; ++links) {
    at += 2;
    const std::string target = text.substr(at, text.find(')', at) - at);
    EXPECT_TRUE(target.starts_with("http") || fs::exists(fs::path(IDENT_SOURCE_DIR) / target)) << target;
  }
  EXPECT_GT(links, 3);
}

}  // namespace
}  // namespace ident
