// A comparison as JSON and as the table of a report.
#pragma once

#include "ident/gap/comparison/differences.h"
#include "ident/result/result.h"

namespace ident {

/// As `differences` of a result: constants of the causes that differ, or (`all`) of every cause compared.
nlohmann::ordered_json differences_json(const std::vector<ComparedCause>& causes, bool all);

/// Constants of both sides beside each other, those that differ first.
Section comparison_section(const std::vector<ComparedCause>& causes);

}  // namespace ident
