// Other causes that would do as well as those named.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/search/search_result.h"
#include "ident/result/result.h"

namespace ident {

/// Names of sets that explain the gap about as well and hold other causes than those named, likeliest first;
/// and what a cause that is small may be as well, by its traits.
std::vector<std::string> in_their_place(const std::vector<std::string>& named, const SearchResult& search,
                                        const std::vector<Parameter>& fitted);

/// The likeliest names where none is certain: those found, those whose model could not be flown, and those
/// that the sets hold for possible.
std::vector<std::string> nearest_names(const SearchResult& search);

}  // namespace ident
