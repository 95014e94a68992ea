// What the commands of a campaign found, kept beside `ident.yaml` and rendered as one page.
#pragma once

#include <string>
#include <vector>

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// Where a result is kept in a campaign's folder: `.ident/thrust.json`. A refinement and a verification of
/// the same logs are kept apart.
std::string stored_result_path(const std::string& folder, const Result& result);

/// The text of that file.
std::string stored_result_text(const Result& result);

/// All results kept in a folder, in the order in which a campaign is done: bench, flight, what follows from
/// them. Throws InputError for a file that is not whole. An input that has changed since is named in a
/// warning.
std::vector<Result> stored_results(const std::string& folder);

/// The parameters that the results found, the last one of a name counting, then what the vehicle file states.
Result campaign_summary(const Vehicle& vehicle, const std::vector<Result>& results);

/// What a vehicle or parameter file states.
Result vehicle_summary(const Vehicle& vehicle);

}  // namespace ident
