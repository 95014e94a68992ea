// Tables for a terminal keep to its width: heads and texts are wrapped, what cannot be is a list.
#include "ident/report/text_table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace ident {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(TextTable, WrapsTextsAndHeadsButNoNumbers) {
  const Table table{.columns = {"what", "mean of all values [m/s]", "meaning"},
                    .rows = {{"a", "(1.25 ± 0.10)e-6", "some words that take more room than there is"},
                             {"b", "(31.5 ± 0.20)e-6", "few words"}}};
  const std::string text = text_table(table, 50);
  for (const std::string& line : lines_of(text)) EXPECT_LE(display_width(line), 50) << line;
  EXPECT_NE(text.find("(1.25 ± 0.10)e-6"), std::string::npos) << text;
  EXPECT_NE(text.find("(31.5 ± 0.20)e-6"), std::string::npos) << text;
}

TEST(TextTable, IsAListWhereNumbersAloneAreTooWide) {
  const Table table{.columns = {"file", "kT", "kQ"},
                    .rows = {{"sweep.csv", "(6.1049 ± 0.0087)e-6", "(8.698 ± 0.012)e-8"},
                             {"other.csv", "(6.2049 ± 0.0087)e-6", "(8.798 ± 0.012)e-8"}}};
  EXPECT_EQ(lines_of(text_table(table, 40)),
            (std::vector<std::string>{"file  sweep.csv", "kT    (6.1049 ± 0.0087)e-6",
                                      "kQ    (8.698 ± 0.012)e-8", "", "file  other.csv",
                                      "kT    (6.2049 ± 0.0087)e-6", "kQ    (8.798 ± 0.012)e-8"}));
}

TEST(TextTable, BreaksNamesOfFilesThatNoLineHolds) {
  const std::string file = "a_long_name_of_a_folder/and_a_file_in_it_that_was_recorded_on_2026-11-21.csv";
  const Table table{.columns = {"file", "kT"}, .rows = {{file, "(6.1049 ± 0.0087)e-6"}}};
  for (const int width : {80, 60, 40, 20}) {
    const std::string text = text_table(table, width);
    for (const std::string& line : lines_of(text))
      EXPECT_LE(display_width(line), std::max(width, 26)) << line;
    EXPECT_NE(text.find("a_long_name_"), std::string::npos) << text;
    EXPECT_NE(text.find(".csv"), std::string::npos) << text;
  }
}

TEST(TextTable, LeavesAloneWhatFits) {
  const Table table{.columns = {"x", "y"}, .rows = {{"1.5", "a b"}, {"10.25", "c"}}};
  EXPECT_EQ(text_table(table, 80), "x      y\n 1.5   a b\n10.25  c\n");
}

}  // namespace
}  // namespace ident
