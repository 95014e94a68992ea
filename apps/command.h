// What a subcommand is: one file apps/NAME.cc with one function that declares options and returns the call.
//
//   Action NAME_command(CLI::App& cli) {
//     auto options = std::make_shared<Options>();
//     cli.add_option("FILE", options->file, "what it is")->required();
//     examples(cli, {{"ident NAME sweep.csv", "what that does"}});
//     return [options](Context& context) -> Outcome { ...; return result; };
//   }
//
// Reading files and estimating is the library's work; printing, report, exit status and provenance are the
// shell's. `--json`, `--report FILE` and `--help` are added to every subcommand by the shell.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/file/write_file.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident::app {

/// What a subcommand is given, and where it leaves what is not part of the result.
struct Context {
  std::vector<std::string> command_line;  ///< as it was typed
  /// Further files that were read (vehicle, map); those in `Result::inputs` count anyway. Hashes go to the
  /// report. With the campaign's `ident.yaml` among them the result is kept for `ident report`.
  std::vector<std::string> used;
  /// Decisions worth telling (separator, units); shown on stderr, in JSON as `notices`.
  std::vector<std::string> notices;
  /// Hashes of large inputs, found beside the work.
  std::map<std::string, std::future<std::string>> hashes;
  Shown shown = Shown::pictures;  ///< of the result
  /// Printed on standard output instead of the result, without --json: a file that has no name.
  std::string plain_output;
  /// Files to write. They appear together after the command has succeeded, or not at all.
  Outputs outputs;
};

/// A result and the exit status that goes with it (not `done` only where the finding itself is the status).
struct Outcome {
  Result result;
  ExitStatus status = ExitStatus::done;
  Outcome(Result found) : result(std::move(found)) {}
  Outcome(Result found, ExitStatus ends_with) : result(std::move(found)), status(ends_with) {}
};

using Action = std::function<Outcome(Context&)>;

#define IDENT_COMMAND(name, summary) Action name##_command(CLI::App& cli);
#include "commands.def"
#undef IDENT_COMMAND

struct Example {
  std::string command, meaning;
};

/// The examples that lead the help of a subcommand.
void examples(CLI::App& cli, const std::vector<Example>& list);

/// Accepts numbers above zero; CLI11's own one tells of a range of 309 digits.
inline CLI::Validator positive_number() {
  return {[](const std::string& text) -> std::string {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            return is_number && value > 0 && std::isfinite(value) ? ""
                                                                  : "'" + text + "' is not a positive number";
          },
          "POSITIVE"};
}

/// A line on stderr for work that takes over a second, on a terminal only.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Share that is done, 0 to 1, and what is being done. May be called often and from several threads.
  void update(double share, const std::string& now = "");

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ident::app
