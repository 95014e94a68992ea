// Outputs appear whole or not at all: killed at any time, on a full disk, on a device that takes nothing.
#include "ident/io/file/write_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ident/core/error.h"
#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSize = 1 << 20;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

/// Runs `action` in a process of its own; its exit status as waitpid gives it. `delay_us`: killed after that.
template <typename Action>
int in_child(Action action, useconds_t delay_us = 0) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  if (delay_us > 0) {
    ::usleep(delay_us);
    ::kill(child, SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(WriteWhole, AKilledProgramLeavesTheOldFileOrTheNewOne) {
  const std::string folder = test_folder(), path = folder + "/out.json";
  const std::string a(kSize, 'a'), b(kSize, 'b');
  write_whole(path, a);
  int killed_while_writing = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const int status = in_child(
        [&] {
          for (;;) write_whole(path, b), write_whole(path, a);
        },
        static_cast<useconds_t>(1000 + 700 * trial));
    EXPECT_TRUE(WIFSIGNALED(status));
    killed_while_writing += files_in(folder) > 1;
    const std::string found = content_of(path);
    EXPECT_TRUE(found == a || found == b) << "trial " << trial << ", " << found.size() << " bytes";
  }
  EXPECT_GT(killed_while_writing, 0);  // else this test shows nothing
  write_whole(path, a);
  EXPECT_EQ(files_in(folder), 1u) << "temporary files of killed programs stay";
}

TEST(WriteWhole, AFullDiskLeavesWhatStoodThereAndNothingElse) {
  const std::string folder = test_folder(), path = folder + "/out.json";
  write_whole(path, "old");
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);  // write() fails instead, as on a full disk
    const rlimit small{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      write_whole(path, std::string(kSize, 'b'));
    } catch (const OutputError&) {
      ::_exit(6);
    }
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 6);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteWhole, OutputsOfOneCommandAppearTogether) {
  const std::string folder = test_folder();
  Outputs outputs;
  outputs.add(folder + "/first.csv", "1");
  outputs.add(folder + "/no such folder/second.csv", "2");
  EXPECT_THROW(outputs.commit(), OutputError);
  EXPECT_FALSE(fs::exists(folder + "/first.csv"));
}

TEST(WriteProgram, EndsWithSixWhereTheReportCannotBeWritten) {
  const std::string folder = test_folder();
  const std::string sweep = write_text(folder, "sweep.csv",
                                       "omega,thrust\n0,0\n100,0.061\n200,0.239\n300,0.542\n400,0.958\n"
                                       "500,1.503\n600,2.157\n700,2.942\n");
  EXPECT_EQ(run_ident({"thrust", sweep}, folder).status, 0);
  const std::size_t before = files_in(folder);
  const ProgramRun run = run_ident({"thrust", sweep, "--report", folder + "/none/report.html"}, folder);
  EXPECT_EQ(run.status, 6) << run.err;
  EXPECT_EQ(files_in(folder), before);
}

}  // namespace
}  // namespace ident
