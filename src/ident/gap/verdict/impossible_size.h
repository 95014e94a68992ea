// Sizes of causes that no cause has: none at all, or beyond what can be on a vehicle.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/search/search_result.h"
#include "ident/result/result.h"

namespace ident {

/// Why one of the causes found cannot be it, as the end of a sentence: fitted in full its only constant is no
/// longer told from that of no such cause, or a payload lies far from the vehicle. Empty if none.
std::string impossible_size(const SearchResult& search, const std::vector<Parameter>& fitted);

}  // namespace ident
