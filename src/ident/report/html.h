// The HTML page of a result: headings, tables and pictures in the order in which they are read.
#pragma once

#include "ident/report/report.h"

namespace ident {

/// One self-contained page that needs no network: everything in `result`, in the order in which it is read.
std::string render_html(const Result& result);

std::string render_html(const std::string& title, std::span<const Result> results);

}  // namespace ident
