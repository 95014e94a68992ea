// The parts of a gap report, and the answer to "where".
#pragma once

#include "ident/gap/evidence/evidence.h"
#include "ident/gap/statistics/residual_wrench.h"
#include "ident/result/result.h"

namespace ident {

std::vector<Section> gap_sections(const nlohmann::ordered_json& found, const ResidualWrench& before,
                                  const ResidualWrench& after, const GapEvidence& evidence = {});

}  // namespace ident
