// Results as text: one HTML page, its Markdown twin, and tables for the terminal. Nothing is computed here.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// One self-contained page that needs no network: everything in `result`, in the order in which it is read.
std::string render_html(const Result& result);
/// All results of a campaign on one page, one chapter each.
std::string render_html(const std::string& title, std::span<const Result> results);

/// The same content for repositories. Pictures are named, not shown; `report_files` shows them.
std::string render_markdown(const Result& result);
std::string render_markdown(const std::string& title, std::span<const Result> results);

/// The contract's JSON with version, command line and the hashes of the inputs: what `--json` prints.
nlohmann::ordered_json json_with_provenance(const Result& result);

/// The form that a file name asks for: .html, .md or .json. Throws UsageError on another ending.
enum class ReportForm { html, markdown, json };
ReportForm report_form(const std::string& path);

struct ReportFile {
  std::string path, content;
};

/// What to write for a report at `path`: the report, and for report.md its pictures in report_figures/. JSON
/// holds the sections too, plots included.
std::vector<ReportFile> report_files(const std::string& path, const Result& result);
std::vector<ReportFile> report_files(const std::string& path, const std::string& title,
                                     std::span<const Result> results);

struct TextStyle {
  bool colour = false;  ///< ANSI colours; ask only for a terminal, and not under NO_COLOR
  int width = 80;       ///< columns
};

/// Verdict, parameters and findings for the terminal, numbers aligned on the decimal point.
std::string render_text(const Result& result, TextStyle style = {});

}  // namespace ident
