// The parts of a gap report, and the answer to "where".
#pragma once

#include "ident/gap/evidence/evidence.h"
#include "ident/gap/statistics/residual_wrench.h"
#include "ident/result/result.h"

namespace ident {

/// `where` of the contract: channels ranked, regimes, bands and times with their share of the explainable
/// residual.
nlohmann::ordered_json where_json(const ResidualWrench& wrench);

std::vector<Section> gap_sections(const nlohmann::ordered_json& found, const ResidualWrench& before,
                                  const ResidualWrench& after, const GapEvidence& evidence = {});

}  // namespace ident
