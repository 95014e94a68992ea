// The parts that every form of a report shares, as tables of text cells: parameters, fit, findings, origin.
#pragma once

#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

/// The verdict in plain words: the command's own, else what was identified; then which findings to look at.
std::string verdict_of(const Result& result);

/// Name, value, unit, interval, deviation (the naive one beside it); prior, pull and the share of the data
/// where any parameter has them; the source where it is not the same for all.
Table parameter_table(const Result& result);

/// The parts after the findings, in the order in which they are read: data health, the digest of the fit,
/// then what the command has to show, which comes first in a diagnosis.
std::vector<Section> sections_in_order(const Result& result);

/// Profiles and held-out flight are read after the correlation matrix, which explains them.
bool follows_correlation(const Section& section);

/// Findings of one kind together, in the order in which the kinds appear.
struct Findings {
  std::string code;
  std::vector<std::string> messages;
};
std::vector<Findings> findings_by_kind(const Result& result);

/// The single numbers of `Result::fit` under their dotted names; what is many stands in the JSON and in the
/// sections. Empty without any.
Table fit_table(const Result& result);

/// Command, version, seed, and the hash of every input: what a stranger needs to repeat the result.
Table provenance_table(const Result& result);

/// What the data do not determine: a line for each reason.
std::vector<std::string> not_identifiable(const Result& result);

/// A text taken apart at its empty lines.
std::vector<std::string> paragraphs_of(const std::string& text);

/// The lines of a paragraph; more than one make a list.
std::vector<std::string> lines_of(const std::string& paragraph);

/// A diagnosis is about causes: its parameters and the health of its data come after its pictures.
bool is_diagnosis(const Result& result);

/// Rates, gaps, units: a part that a report has, and a terminal leaves out.
bool is_data_health(const Section& section);

/// "ident flightlog --refine" from the command, as the title of a page or a chapter.
std::string title_of(const Result& result);

/// The command as it was typed, without the folder of the program, quoted for the shell where needed.
std::string command_line_of(const Result& result);

}  // namespace ident
