// Results as text: one HTML page, its Markdown twin, and tables for the terminal. Nothing is computed here.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// All results of a campaign on one page, one chapter each.

/// The form that a file name asks for: .html, .md or .json. Throws UsageError on another ending.
enum class ReportForm { html, markdown, json };

struct ReportFile {
  std::string path, content;
};

struct TextStyle {
  bool colour = false;  ///< ANSI colours; ask only for a terminal, and not under NO_COLOR
  int width = 80;       ///< columns
};

}  // namespace ident
