// Draws signatures, and writes them into the JSON without their points.
#pragma once

#include <vector>

#include "ident/gap/evidence/signature.h"
#include "ident/result/result.h"

namespace ident {

nlohmann::ordered_json to_json(const std::vector<Signature>& signatures);

/// Scatter, fitted line and 3-sigma band of each; no section when no cause was named.
std::vector<Section> signature_sections(const std::vector<Signature>& signatures);

}  // namespace ident
