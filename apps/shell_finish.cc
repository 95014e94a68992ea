// The end of every command: provenance, report, all outputs at once, standard output last.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "ident/core/stage_times.h"
#include "ident/io/file/sha256.h"
#include "ident/report/campaign_report.h"
#include "ident/report/report_files.h"
#include "ident/report/text.h"
#include "shell.h"

namespace ident::app {
namespace {

namespace fs = std::filesystem;

bool colour_wanted() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (terminal != nullptr && std::string_view(terminal) == "dumb") return false;
  return ::isatty(STDOUT_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

std::string json_text(const Result& result) {
  // File names may hold bytes that are no UTF-8: replaced, not refused.
  return json_with_provenance(result).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Keeps the result of a command that read `ident.yaml` beside it, where `ident report` finds it.
void keep_in_campaign(const Result& result, Context& context) {
  if (std::ranges::count(context.used, "ident.yaml") == 0) return;
  const std::string path = stored_result_path(".", result);
  std::error_code failed;
  fs::create_directories(fs::path(path).parent_path(), failed);
  if (failed)
    context.notices.push_back("the result is not kept for `ident report`: " + failed.message());
  else
    context.outputs.add(path, stored_result_text(result));
}

void print(const std::string& text) {
  const bool complete = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!complete || std::fflush(stdout) != 0) throw OutputError("standard output cannot be written");
}

std::string terminal_text(const Result& result, const Context& context) {
  if (!context.print.empty()) return context.print;
  std::string text = render_text(result, {.colour = colour_wanted()});
  if (const std::string next = next_command(result, context); !next.empty()) text += "Next: " + next + "\n";
  return text;
}

/// One line for what was decided about each file, in the order of the files.
std::string notes(const std::vector<std::string>& notices) {
  std::vector<std::pair<std::string, std::string>> by_file;
  for (const std::string& notice : notices) {
    const std::size_t end = notice.find(": ");
    const bool named = end != std::string::npos && notice.find(' ') > end;
    const std::string file = named ? notice.substr(0, end + 2) : "";
    auto at = std::ranges::find(by_file, file, &std::pair<std::string, std::string>::first);
    if (file.empty() || at == by_file.end()) at = by_file.insert(by_file.end(), {file, ""});
    at->second += (at->second.empty() ? "" : "; ") + notice.substr(file.size());
  }
  std::string text;
  for (const auto& [file, decisions] : by_file) text += fmt::format("note: {}{}\n", file, decisions);
  return text;
}

}  // namespace

void add_provenance(Result& result, Context& context) {
  const auto hash_of = [&](const std::string& path) {
    const auto begun = context.hashes.extract(path);
    return begun ? begun.mapped().get() : sha256_of_file(path);
  };
  std::vector<std::string> paths = result.inputs;
  paths.insert(paths.end(), context.used.begin(), context.used.end());
  for (const std::string& path : paths) {
    const bool known = std::ranges::any_of(result.files, [&](const InputFile& f) { return f.path == path; });
    if (!known && fs::is_regular_file(path)) result.files.push_back({path, hash_of(path)});
  }
  result.command_line = context.command_line;
  if (!context.notices.empty()) result.extra["notices"] = context.notices;
}

void add_report(Outputs& outputs, const std::vector<ReportFile>& files) {
  for (const ReportFile& file : files) {
    std::error_code ignored;  // without the folder the file cannot be written, which has its own message
    if (&file != &files.front()) fs::create_directories(fs::path(file.path).parent_path(), ignored);
    outputs.add(file.path, file.content);
  }
}

ExitStatus finish(Outcome outcome, Context& context, const SharedOptions& options) {
  const Stage stage("report and outputs");
  Result& result = outcome.result;
  add_provenance(result, context);
  if (!options.report.empty()) add_report(context.outputs, report_files(options.report, result));
  keep_in_campaign(result, context);
  const std::string text = options.json ? json_text(result) : terminal_text(result, context);
  context.outputs.prepare();
  print(text);
  context.outputs.commit();
  if (!options.json) fmt::print(stderr, "{}", notes(context.notices));
  if (!options.json && !context.print.empty())
    for (const Warning& warning : result.warnings) fmt::print(stderr, "warning: {}\n", warning.message);
  return outcome.status;
}

}  // namespace ident::app
