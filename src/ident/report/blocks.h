// The parts that every form of a report shares, as tables of text cells: parameters, fit, findings, origin.
#pragma once

#include <string>
#include <vector>

#include "ident/core/result.h"

namespace ident {

/// Name, value, unit, interval, deviation (the naive one beside it) and source; prior, pull and the share of
/// the data where any parameter has them.
Table parameter_table(const Result& result);

/// The numbers of `Result::fit` under their dotted names; empty without any.
Table fit_table(const Result& result);

/// Command, version, seed, and the hash of every input: what a stranger needs to repeat the result.
Table provenance_table(const Result& result);

/// A line for each parameter that the data do not determine, with the reason.
std::vector<std::string> not_identifiable(const Result& result);

/// A text taken apart at its empty lines.
std::vector<std::string> paragraphs_of(const std::string& text);

/// "ident thrust" from the command, as the title of a page or a chapter.
std::string title_of(const Result& result);

/// The command as it was typed, quoted for the shell where needed.
std::string command_line_of(const Result& result);

}  // namespace ident
