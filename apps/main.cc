// Entry of the program `ident`: finds the subcommand, turns errors into exit status.
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <iostream>
#include <new>

#include "ident/core/version.h"
#include "ident/report/report.h"
#include "ident/report/report_files.h"
#include "shell.h"

namespace ident::app {
namespace {

struct Registered {
  CLI::App* cli;
  Action action;
  std::shared_ptr<SharedOptions> shared;
};

Registered add(CLI::App& program, const std::string& name, const std::string& summary,
               Action (*declare)(CLI::App&)) {
  CLI::App* cli = program.add_subcommand(name, summary);
  auto shared = std::make_shared<SharedOptions>();
  const Action action = declare(*cli);
  cli->add_flag("--json", shared->json, "print the result as JSON on standard output, nothing else");
  cli->add_flag("--timing", shared->timing, "tell on stderr where the time went");
  if (cli->get_option_no_throw("--report") != nullptr) return {cli, action, shared};  // its own
  cli->add_option("--report", shared->report, "write a report: .html, .md or .json")
      ->type_name("FILE")
      ->each([](const std::string& path) {  // refused before the work, not after
        report_form(path);
        require_folder_of(path);
      });
  return {cli, action, shared};
}

std::vector<Registered> add_commands(CLI::App& program) {
  std::vector<Registered> list;
#define IDENT_COMMAND(name, summary) list.push_back(add(program, #name, summary, &name##_command));
#include "commands.def"
#undef IDENT_COMMAND
  return list;
}

// Logs and tables come and go in vectors of some hundred kilobytes: given back to the system each time, a
// tenth of a refinement would go to getting them again.
void keep_freed_memory() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kMost = 1 << 25;  // the library takes no more for the first of these
  mallopt(M_MMAP_THRESHOLD, kMost);
  mallopt(M_TRIM_THRESHOLD, 8 * kMost);
  mallopt(M_TOP_PAD, kMost / 4);
#endif
}

int run(int argc, char** argv) {
  CLI::App program(
      "Identifies multirotors from bench and flight data and diagnoses what a simulation lacks.");
  program.name("ident");
  program.formatter(help_layout());
  program.set_version_flag("--version", std::string("ident ") + version());
  program.require_subcommand(1);
  examples(program, {{"ident thrust sweep.csv", "thrust and torque constants from a bench sweep"},
                     {"ident flightlog flight.csv --vehicle v.yaml --refine", "parameters from a flight"},
                     {"ident gap flight.csv --vehicle v.yaml", "which effect does the model lack?"}});
  const std::vector<Registered> commands = add_commands(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    std::cerr << "ident: " << usage_message(program, error) << "\n";
    return static_cast<int>(ExitStatus::bad_input);
  }
  for (const Registered& command : commands) {
    if (!command.cli->parsed()) continue;
    Context context{.command_line = std::vector<std::string>(argv, argv + argc)};
    if (command.shared->report.empty()) context.shown = command.shared->json ? Shown::numbers : Shown::tables;
    Outcome outcome = command.action(context);
    const ExitStatus status = finish(std::move(outcome), context, *command.shared);
    if (command.shared->timing) std::cerr << timing_table();
    return static_cast<int>(status);
  }
  return static_cast<int>(ExitStatus::bad_input);
}

}  // namespace
}  // namespace ident::app

int main(int argc, char** argv) {
  using ident::ExitStatus;
  try {
    ident::app::keep_freed_memory();
    return ident::app::run(argc, argv);
  } catch (const ident::Error& error) {
    std::cerr << "ident: " << error.what() << "\n";
    return static_cast<int>(error.status());
  } catch (const std::bad_alloc&) {
    std::cerr << "ident: not enough memory for this input\n";
  } catch (const std::exception& error) {
    std::cerr << "ident: unexpected failure: " << error.what() << "\n";
  }
  return static_cast<int>(ExitStatus::data_do_not_allow);
}
