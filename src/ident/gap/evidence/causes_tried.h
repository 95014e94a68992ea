// Every cause of the catalogue as a diagnosis reports it: how probable, how large, how small it could be
// seen.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/search/search_result.h"

namespace ident {

/// One entry for each cause tried, most probable first (`candidates` of the result). `closed_alone` gives the
/// what an adopted cause closes of the gap without the others.
nlohmann::ordered_json causes_tried(const SearchResult& search,
                                    const std::function<GapClosed(const Candidate&)>& closed_alone);

/// The effects found that are smaller than so many `times` what would have been seen of them.
std::vector<std::string> below_their_limit(const SearchResult& search, double times);

/// Effects of the catalogue that were not tried, each with the reason.
nlohmann::ordered_json causes_not_tried(const SearchResult& search, const Vehicle& vehicle,
                                        const std::vector<std::string>& exclude);

}  // namespace ident
