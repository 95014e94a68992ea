// The list of findings: every code of the sources is in it, and every text says what the sources do.
#include "ident/result/findings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ident/views/findings_list.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = IDENT_SOURCE_DIR;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> sources() {
  std::vector<fs::path> files;
  for (const char* folder : {"src/ident", "apps"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
      if (const fs::path end = entry.path().extension(); end == ".cc" || end == ".h")
        files.push_back(entry.path());
  return files;
}

/// All groups of all matches.
std::set<std::string> matches(const std::string& text, const std::regex& expression) {
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    for (std::size_t group = 1; group < at->size(); ++group)
      if ((*at)[group].matched) found.insert((*at)[group]);
  return found;
}

const std::string kCode = "\"([a-z][a-z0-9]*(?:_[a-z0-9]+)*)\"";

/// Codes of the warnings and violations that a source makes.
std::set<std::string> codes_issued_by(const std::string& text) {
  static const std::vector<std::regex> direct = {
      std::regex(R"(\bwarn\(\s*)" + kCode),
      std::regex(R"((?:warnings_?|findings|found|said)(?:\.|->)push_back\(\s*\{\s*)" + kCode +
                 R"(,\s*(?:fmt::format|"|what|told|text|message|log_?\.file))"),
      std::regex(R"(Warning\{\s*(?:\w+ \? )?)" + kCode + R"((?:\s*:\s*)" + kCode + ")?,"),
      std::regex(R"((?:violated|doubtful)\(\s*[^{;]*\{\s*)" + kCode + ","),
      std::regex(R"(Warning \w+(?:::\w+)?\([^)]*\)(?: const)? \{[^}]*?return \{\s*)" + kCode + ","),
      std::regex(R"(return\s*\{\s*\{\s*)" + kCode + R"(,\s*fmt::format)"),
      std::regex(R"(return \{)" + kCode + R"(,\s*")")};
  static const std::vector<std::regex> by_helper = {
      std::regex(R"(\b(?:say|add)\((?:[^;{}]*?[\s(])?)" + kCode + R"(,\s*")"),
      std::regex(R"(\?\s*)" + kCode + R"(\s*:\s*)" + kCode + ",")};
  std::set<std::string> codes;
  for (const std::regex& pattern : direct) codes.merge(matches(text, pattern));
  if (text.find("push_back({code,") == std::string::npos) return codes;
  for (const std::regex& pattern : by_helper) codes.merge(matches(text, pattern));
  return codes;
}

std::vector<std::string> sentences(const std::string& text) {
  std::vector<std::string> list;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at)
    if (text[at] == '.' && (at + 1 == text.size() || text[at + 1] == ' '))
      list.push_back(text.substr(begin, at + 1 - begin)), begin = at + 1;
  if (begin < text.size()) list.push_back(text.substr(begin));
  return list;
}

std::ptrdiff_t words(const std::string& text) {
  std::istringstream in(text);
  return std::distance(std::istream_iterator<std::string>(in), {});
}

TEST(Findings, EveryCodeThatTheProgramIssuesIsInTheList) {
  std::size_t found = 0;
  for (const fs::path& file : sources())
    for (const std::string& code : codes_issued_by(content(file))) {
      ++found;
      EXPECT_NE(find_finding(code), nullptr) << file << " issues " << code;
    }
  EXPECT_GT(found, 100U);  // else the patterns find nothing any more
}

TEST(Findings, EveryCodeThatTheProgramAsksForIsInTheList) {
  const std::vector<std::regex> patterns = {std::regex(R"(has_warning\()" + kCode),
                                            std::regex(R"(\.code == )" + kCode),
                                            std::regex(kCode + ", &Warning::code")};
  for (const fs::path& file : sources())
    for (const std::regex& pattern : patterns)
      for (const std::string& code : matches(content(file), pattern))
        EXPECT_NE(find_finding(code), nullptr) << file << " asks for " << code;
}

TEST(Findings, EveryCodeOfTheListIsIssued) {
  const std::regex code(kCode);
  std::set<std::string> literals;
  for (const fs::path& file : sources()) literals.merge(matches(content(file), code));
  for (const FindingInfo& finding : all_findings())
    EXPECT_TRUE(literals.contains(std::string(finding.code))) << finding.code << " is issued nowhere";
}

TEST(Findings, CodesAreUnique) {
  std::set<std::string_view> codes;
  for (const FindingInfo& finding : all_findings())
    EXPECT_TRUE(codes.insert(finding.code).second) << finding.code;
}

TEST(Findings, TextsAreSentencesOfAtMostTwentyFiveWords) {
  for (const FindingInfo& finding : all_findings())
    for (const std::string_view text : {finding.seen, finding.consequence, finding.advice}) {
      EXPECT_TRUE(text.ends_with('.')) << finding.code << ": " << text;
      for (const std::string& sentence : sentences(std::string(text)))
        EXPECT_LE(words(sentence), 25) << finding.code << ": " << sentence;
    }
}

// "(kUsual, kMost in io/log_cleaning/log_spikes.cc)": a renamed constant or a moved file is found here.
TEST(Findings, ConstantsThatTheTextsNameStandInTheirFiles) {
  const std::regex named(R"(((?:k[A-Z]\w*(?:, )?)*)(?: in )?([\w/]+/\w+\.(?:cc|h))\b)"),
      name(R"((k[A-Z]\w*))");
  for (const FindingInfo& finding : all_findings()) {
    const std::string all = std::string(finding.seen) + " " + std::string(finding.consequence);
    for (std::sregex_iterator at(all.begin(), all.end(), named), end; at != end; ++at) {
      const fs::path file = kSource / "src/ident" / (*at)[2].str();
      ASSERT_TRUE(fs::exists(file)) << finding.code << " names " << (*at)[2];
      for (const std::string& constant : matches((*at)[1], name))
        EXPECT_TRUE(std::regex_search(content(file), std::regex("\\b" + constant + "\\b")))
            << finding.code << " names " << constant << " of " << (*at)[2];
    }
  }
}

TEST(Findings, TheGuidesPageIsTheList) {
  EXPECT_EQ(content(kSource / "notebooks/guide/warnings.md"), findings_page())
      << "write it anew: ident check --list --markdown notebooks/guide/warnings.md";
}

TEST(Findings, TheListHoldsEveryCodeOnceAsTextAndAsJson) {
  const Result list = findings_list();
  EXPECT_EQ(list.extra["findings"].size(), all_findings().size());
  std::size_t rows = 0;
  for (const Section& section : list.sections)
    for (const Table& table : section.tables) rows += table.rows.size();
  EXPECT_EQ(rows, all_findings().size());
  EXPECT_TRUE(list.warnings.empty());
}

}  // namespace
}  // namespace ident
