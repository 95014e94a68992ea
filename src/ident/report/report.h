// Results as text: one HTML page, its Markdown twin, and tables for the terminal. Nothing is computed here.
#pragma once

#include <span>
#include <string>

#include "ident/core/result.h"

namespace ident {

/// One self-contained page that needs no network: everything in `result`, in the order in which it is read.
std::string render_html(const Result& result);
/// All results of a campaign on one page, one chapter each.
std::string render_html(const std::string& title, std::span<const Result> results);

/// The same content for repositories.
std::string render_markdown(const Result& result);
std::string render_markdown(const std::string& title, std::span<const Result> results);

/// The form that a file name asks for: .html, .md or .json. Throws UsageError on another ending.
enum class ReportForm { html, markdown, json };
ReportForm report_form(const std::string& path);

/// The content of a report file. JSON holds everything, sections and plots included.
std::string render_as(ReportForm form, const std::string& title, std::span<const Result> results);

struct TextStyle {
  bool colour = false;  ///< ANSI colours; ask only for a terminal, and not under NO_COLOR
  int width = 80;       ///< columns
};

/// Verdict, parameters and findings for the terminal, numbers aligned on the decimal point.
std::string render_text(const Result& result, TextStyle style = {});

}  // namespace ident
