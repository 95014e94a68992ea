// What probabilities and sizes of causes are worth once a verdict is known.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ident/gap/hypotheses/candidates.h"
#include "ident/result/result.h"

namespace ident {

/// Probabilities of `candidates` (as causes_tried gives them) are among the causes of the catalogue. Where
/// those found are not named they are less than that; a cause that is named all the same keeps its own.
void trust_less(nlohmann::ordered_json& candidates, const std::vector<std::string>& named);

/// Causes that are there whatever else is, as the flight shows by itself: the search, which asks what
/// explains it all, may have had them for less probable.
void trust_more(nlohmann::ordered_json& candidates, const std::vector<std::string>& plain);

/// Values that only one of the causes would have are not known where it is not named.
void doubt_refused(std::vector<Parameter>& parameters, const std::vector<Candidate>& causes);

}  // namespace ident
