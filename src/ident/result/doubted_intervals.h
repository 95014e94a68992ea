// Intervals of constants that do not count as known.
#pragma once

#include <vector>

#include "ident/result/parameter.h"

namespace ident {

/// Whatever makes a constant doubtful may have moved it from what was stated to where it is: its deviation
/// becomes at least that distance, and its interval holds it. For results that nothing is decided by any
/// more. Constants that are known together with others keep theirs.
void widen_doubted(std::vector<Parameter>& parameters);

}  // namespace ident
