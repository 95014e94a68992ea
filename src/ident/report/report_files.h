// The files of a report, chosen by the ending of its name.
#pragma once

#include "ident/report/report.h"

namespace ident {

/// The contract's JSON with version, command line and the hashes of the inputs: what `--json` prints.
nlohmann::ordered_json json_with_provenance(const Result& result);

ReportForm report_form(const std::string& path);
/// What to write for a report at `path`: the report, and for report.md its pictures in report_figures/. JSON
/// holds the sections too, plots included.
std::vector<ReportFile> report_files(const std::string& path, const Result& result);

std::vector<ReportFile> report_files(const std::string& path, const std::string& title,
                                     std::span<const Result> results);

}  // namespace ident
