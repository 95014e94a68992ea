// What the program shows on a terminal: help within 80 columns that leads with examples, one note a file, and
// the next command.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kSample = fs::path(IDENT_SOURCE_DIR) / "data/sample";

std::string sample_campaign() {
  const fs::path folder = fs::path(test_folder()) / "campaign";
  fs::remove_all(folder);
  fs::copy(kSample, folder, fs::copy_options::recursive);
  return folder.string();
}

std::size_t widest_line(const std::string& text) {
  std::size_t width = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) width = std::max(width, line.size());
  return width;
}

/// What a command shows to somebody who sits before it: `script` gives it a terminal.
std::string on_terminal(const std::string& arguments, const std::string& environment = "") {
  const std::string command = "cd '" + sample_campaign() + "' && TERM=xterm " + environment +
                              " script -qec '" + IDENT_PROGRAM + " " + arguments +
                              "' /dev/null 2>&1 < /dev/null";
  std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string shown;
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe.get())) > 0;)
    shown.append(chunk.data(), n);
  return shown;
}

TEST(Terminal, HelpLeadsWithExamplesAndKeepsToEightyColumns) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{},
                                                  {"thrust"},
                                                  {"motor"},
                                                  {"inertia"},
                                                  {"flightlog"},
                                                  {"gap"},
                                                  {"slant"},
                                                  {"check"},
                                                  {"report"},
                                                  {"simulate", "flight"},
                                                  {"simulate", "thrust"},
                                                  {"simulate", "motor"},
                                                  {"simulate", "inertia"}}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back("--help");
    const std::string help = run_ident(arguments).out;
    const std::string name = command.empty() ? "ident" : command.back();
    EXPECT_LE(widest_line(help), 80U) << name << "\n" << help;
    EXPECT_LT(help.find("Examples:"), help.find("Usage:")) << name;
  }
}

TEST(Terminal, SuggestsTheNextCommandOfTheCampaign) {
  const std::string folder = sample_campaign();
  EXPECT_NE(run_ident({"thrust"}, folder).out.find("Next: ident motor\n"), std::string::npos);
  EXPECT_NE(run_ident({"motor"}, folder).out.find("Next: ident inertia\n"), std::string::npos);
  EXPECT_NE(run_ident({"inertia"}, folder).out.find("Next: ident gap\n"), std::string::npos);
  EXPECT_EQ(run_ident({"motor", "--json"}, folder).out.find("Next"), std::string::npos);
}

TEST(Terminal, SuggestsWhatToDoWithTheFileJustMade) {
  const std::string folder = sample_campaign();
  const ProgramRun made = run_ident(
      {"simulate", "thrust", "--vehicle",
       (fs::path(IDENT_SOURCE_DIR) / "data/sample_truth/falcon_truth.yaml").string(), "--output", "mine.csv"},
      folder);
  EXPECT_NE(made.out.find("Next: ident thrust mine.csv\n"), std::string::npos) << made.out << made.err;
}

TEST(Terminal, NotesOneLineForEachLogAndPaintsNothingOffATerminal) {
  const ProgramRun run = run_ident({"flightlog"}, sample_campaign());
  EXPECT_EQ(run.status, 0);
  std::istringstream lines(run.err);
  int notes = 0;
  for (std::string line; std::getline(lines, line); ++notes)
    EXPECT_TRUE(line.starts_with("note: flight_")) << line;
  EXPECT_EQ(notes, 2);
  EXPECT_EQ(run.out.find('\033'), std::string::npos);
  EXPECT_LE(widest_line(run.out), 80U);
}

TEST(Terminal, PaintsOnATerminalUnlessNoColorIsSet) {
  if (!fs::exists("/usr/bin/script")) GTEST_SKIP() << "bsdutils, which gives a terminal, is not installed";
  const std::string bold = "\033[1m";
  const std::string painted = on_terminal("inertia"), plain = on_terminal("inertia", "NO_COLOR=1");
  EXPECT_NE(painted.find(bold), std::string::npos) << painted;
  EXPECT_NE(plain.find("Jxx"), std::string::npos) << plain;
  EXPECT_EQ(plain.find(bold), std::string::npos) << plain;
}

TEST(Terminal, ShowsHowFarADiagnosisIsWhatItTriesAndTheTimeLeft) {
  if (!fs::exists("/usr/bin/script")) GTEST_SKIP() << "bsdutils, which gives a terminal, is not installed";
  const std::string shown = on_terminal("gap");
  for (const char* part : {"\r\033[Kdiagnosing 90 %, about ", " s left: held-out flight"})
    EXPECT_NE(shown.find(part), std::string::npos) << part << shown;
}

TEST(Terminal, NamesTheNearestWordOfAMistypedCommandOrOption) {
  EXPECT_NE(run_ident({"thrst"}).err.find("did you mean 'thrust'?"), std::string::npos);
  EXPECT_NE(run_ident({"gap", "--exlude", "x"}).err.find("did you mean '--exclude'?"), std::string::npos);
}

TEST(Terminal, TimingGoesToStderrAndLeavesTheResultAsItIs) {
  const std::string sweep = (kSample / "thrust_sweep.csv").string();
  const ProgramRun plain = run_ident({"thrust", sweep}), timed = run_ident({"thrust", sweep, "--timing"});
  EXPECT_EQ(timed.status, 0);
  EXPECT_EQ(timed.out, plain.out);
  EXPECT_NE(timed.err.find("report and outputs"), std::string::npos) << timed.err;
  EXPECT_NE(timed.err.find("s of processor time"), std::string::npos) << timed.err;
}

TEST(Terminal, AFolderThatIsNotThereIsToldBeforeTheWork) {
  for (const std::vector<std::string>& output :
       {std::vector<std::string>{"--report", "no/such/r.html"}, {"--write-params", "no/such/v.yaml"}}) {
    std::vector<std::string> arguments{"gap", "no_such_log.csv"};
    arguments.insert(arguments.end(), output.begin(), output.end());
    const ProgramRun run = run_ident(arguments);
    EXPECT_NE(run.status, 0);
    EXPECT_NE(run.err.find("there is no folder no/such to write it into"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace ident
