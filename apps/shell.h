// The parts of the program around the subcommands: help, and the end of every command.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "ident/report/report.h"

namespace ident::app {

/// Options that the shell adds to every subcommand.
struct SharedOptions {
  bool json = false, timing = false;
  std::string report;
};

/// Layout of help texts: summary, examples, then usage and options.
std::shared_ptr<CLI::FormatterBase> help_layout();

/// What is wrong with the command line, with the nearest word that would have been right.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error);

/// Adds the files of a report; the folder of its pictures is made.
void add_report(Outputs& outputs, const std::vector<ReportFile>& files);

/// Adds to a result what a stranger needs to repeat it: the command line, the hashes of all files read.
void add_provenance(Result& result, Context& context);

/// What to run next, as a command line; empty where nothing suggests itself.
std::string next_command(const Result& result, const Context& context);

/// Where the time went, as lines for stderr.
std::string timing_table();

/// Completes the result, writes all outputs, prints. Returns the exit status.
ExitStatus finish(Outcome outcome, Context& context, const SharedOptions& options);

}  // namespace ident::app
