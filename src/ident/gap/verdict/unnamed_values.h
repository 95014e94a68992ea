// Constants of causes that were found and are not named.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/hypotheses/candidates.h"
#include "ident/result/result.h"

namespace ident {

/// Values that only a cause would have are not known where it is not among those `named`.
void doubt_unnamed(std::vector<Parameter>& parameters, const std::vector<Candidate>& causes,
                   const std::vector<std::string>& named);

}  // namespace ident
