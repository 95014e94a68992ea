// The program as a child process, its streams in files.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ident/io/vehicle/vehicle_write.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

ProgramRun run_ident(const std::vector<std::string>& arguments, const std::string& folder) {
  const fs::path streams = fs::path(test_folder()) / ".streams";
  fs::create_directories(streams);
  std::string command = "cd " + shell_quoted(folder) + " && " + shell_quoted(IDENT_PROGRAM);
  for (const std::string& argument : arguments) command += " " + shell_quoted(argument);
  command +=
      " >" + shell_quoted((streams / "out").string()) + " 2>" + shell_quoted((streams / "err").string());
  const int ended = std::system(command.c_str());
  return {.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended),
          .out = content(streams / "out"),
          .err = content(streams / "err")};
}

std::string test_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder = fs::path(testing::TempDir()) / "ident_tests" /
                          (std::string(info->test_suite_name()) + "." + info->name());
  static std::string made;
  if (made != folder) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    made = folder.string();
  }
  return folder.string();
}

std::string write_text(const std::string& folder, const std::string& name, const std::string& text) {
  const fs::path path = fs::path(folder) / name;
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

}  // namespace ident
