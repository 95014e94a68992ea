// Runs the program `ident` as a user does, and gives what it printed and how it ended.
#pragma once

#include <string>
#include <vector>

namespace ident {

struct ProgramRun {
  int status = -1;  ///< exit status; 128 + signal when it was killed
  std::string out, err;
};

/// Runs `ident` with these arguments in a folder.
ProgramRun run_ident(const std::vector<std::string>& arguments, const std::string& folder = ".");

/// A folder of its own for the running test, empty at first.
std::string test_folder();

/// Writes a text file into a folder; its path.
std::string write_text(const std::string& folder, const std::string& name, const std::string& text);

}  // namespace ident
