// Two files of one flight: a log without attitude, and motion capture with a clock of its own.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/run_program.h"

namespace ident {
namespace {

const std::string kSample = std::string(IDENT_SOURCE_DIR) + "/data/sample";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The columns of the sample's flight whose names are asked for, with its times moved by `later` s.
std::string columns(const std::string& file, const std::function<bool(const std::string&)>& wanted,
                    double later) {
  std::ifstream in(kSample + "/" + file);
  std::string line, out;
  while (std::getline(in, line) && line.starts_with('#')) {
  }
  const std::vector<std::string> names = cells_of(line);
  const auto put = [&](const std::vector<std::string>& cells, bool head) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!wanted(names[i])) continue;
      const std::string cell = i < cells.size() ? cells[i] : "";
      const bool time = names[i] == "t" && !head;
      out += (out.empty() || out.back() == '\n' ? "" : ",") +
             (time ? std::to_string(std::stod(cell) + later) : cell);
    }
    out += '\n';
  };
  put(names, true);
  while (std::getline(in, line)) put(cells_of(line), false);
  return out;
}

bool of_motion(const std::string& name) {
  return name.starts_with("q") ? name.size() == 2 : name == "x" || name == "y" || name == "z";
}

struct Files {
  std::string folder = test_folder(), log, capture;
};

Files files_of_one_flight() {
  Files files;
  files.log =
      write_text(files.folder, "log.csv",
                 columns(
                     "flight_mixed.csv",
                     [](const std::string& name) { return !of_motion(name) && name[0] != 'v'; }, 0.0));
  files.capture = write_text(
      files.folder, "capture.csv",
      columns(
          "flight_mixed.csv", [](const std::string& name) { return name == "t" || of_motion(name); }, 1e5));
  return files;
}

TEST(Motion, IsLaidOnTheLog) {
  const Files files = files_of_one_flight();
  const ProgramRun run =
      run_ident({"flightlog", files.log, "--vehicle", kSample + "/falcon.yaml", "--motion", files.capture},
                files.folder);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string told = "attitude and position are those of " + files.capture + ", ";
  const std::size_t at = run.err.find(told);
  ASSERT_NE(at, std::string::npos) << run.err;
  EXPECT_NEAR(std::stod(run.err.substr(at + told.size())), -1e5, 2e-3);
  EXPECT_NE(run.out.find("attitude x"), std::string::npos) << run.out;
  EXPECT_NE((run.out + run.err).find(" --motion " + files.capture + " --vehicle"), std::string::npos)
      << "what comes next\n"
      << run.out;
}

TEST(Motion, ACampaignNamesIt) {
  const Files files = files_of_one_flight();
  write_text(files.folder, "ident.yaml",
             "vehicle: " + kSample + "/falcon.yaml\nlogs: [{file: log.csv, motion: capture.csv}]\n");
  const ProgramRun run = run_ident({"flightlog"}, files.folder);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("are those of capture.csv"), std::string::npos) << run.err;
}

TEST(Motion, SaysWhatIsWrong) {
  const Files files = files_of_one_flight();
  const auto told = [&](std::vector<std::string> more, int status) {
    std::vector<std::string> arguments{"flightlog", files.log, "--vehicle", kSample + "/falcon.yaml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_ident(arguments, files.folder);
    EXPECT_EQ(run.status, status) << run.err;
    return run.err;
  };
  EXPECT_NE(told({"--motion", files.log}, 2).find("log.csv:1: qw..qz or phi,theta,psi"), std::string::npos);
  EXPECT_NE(told({"--motion", kSample + "/flight_eight.csv"}, 1).find("does not turn as"), std::string::npos);
  EXPECT_NE(told({"--motion", files.capture, "--motion", files.capture}, 2).find("one recording for each"),
            std::string::npos);
  EXPECT_NE(told({"--motion-map", files.capture}, 2).find("--motion"), std::string::npos);
}

}  // namespace
}  // namespace ident
