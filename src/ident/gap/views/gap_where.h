// Where the residual lies, by channel, regime, frequency band and time.
#pragma once

#include "ident/gap/views/gap_sections.h"

namespace ident {

/// `where` of the contract: channels ranked, regimes, bands and times with their share of the explainable
/// residual.
nlohmann::ordered_json where_json(const ResidualWrench& wrench);

}  // namespace ident
