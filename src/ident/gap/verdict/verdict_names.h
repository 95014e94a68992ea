// Which names a verdict gives: of the causes found, and of those that would do in their place.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/search/search_result.h"
#include "ident/result/result.h"

namespace ident {

/// Those found, without those that were taken up and are hardly there once all are weighed by the scatter of
/// the strongest: they mend its form. A battery that thrust itself shows is weighed otherwise.
std::vector<std::string> probable_names(const SearchResult& search, const std::vector<Parameter>& fitted);

/// Names that the flight leaves open where none of them could be tried, likeliest first.
std::vector<std::string> likely_names(const SearchResult& search);

/// What else could stand in the place of the names found.
std::vector<std::string> names_in_place_of(const std::vector<std::string>& names, const SearchResult& search,
                                           const std::vector<Parameter>& fitted);

}  // namespace ident
