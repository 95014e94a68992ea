// Search for the set of causes: adopt the best, refit, look again; exchange what the weights speak against.
#pragma once

#include <functional>

#include "ident/gap/search/search_result.h"

namespace ident {

struct SearchOptions {
  std::vector<std::string> exclude;
  int most_causes;  ///< in the vehicle; how its sensor is mounted comes on top
  bool hover;       ///< these logs hold little more than that: what it does not tell stays as known
  bool fine_gusts;  ///< gusts in steps as short as a refinement has them
  std::function<void(double, const std::string&)> progress;
};

SearchResult search_causes(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
                           const SearchOptions& options);

}  // namespace ident
