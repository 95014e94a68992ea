// A result for the terminal: verdict, parameters, what was not identified, findings.
#pragma once

#include "ident/report/report.h"

namespace ident {

/// Verdict, parameters and findings for the terminal, numbers aligned on the decimal point.
std::string render_text(const Result& result, TextStyle style = {});

}  // namespace ident
