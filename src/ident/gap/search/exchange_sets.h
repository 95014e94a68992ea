// Other sets of causes in place of those that a search found.
#pragma once

#include <vector>

#include "ident/gap/search/search_state.h"

namespace ident {

/// Sets that were looked at in full in place of those found.
using LookedAt = std::vector<std::vector<Candidate>>;

/// Where the weights speak against the causes found: the set that they prefer, if they still do with it in
/// the model. What came first was chosen with the others missing. False where nothing was exchanged.
bool exchange(SearchState& s);

/// Strong causes are weighed far from where they act. Where those found leave something to others, sets of as
/// many that weigh little less are looked at in full, and one is taken that leaves less.
bool take_alternative(SearchState& s, LookedAt& looked_at);

}  // namespace ident
