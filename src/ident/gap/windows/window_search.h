// The causes that forces and moments along measured motion show.
#pragma once

#include "ident/gap/search/search_result.h"
#include "ident/gap/windows/window_model.h"

namespace ident {

struct WindowSearch {
  SearchResult result;
  WindowStanding base, best;
};

/// Adds the cause that explains most, fits, and goes on; drops what the others do the work of; and moves to
/// another set where that is more probable. At most so many causes, none of `exclude`.
WindowSearch search_windows(const WindowModel& model, const Vehicle& vehicle, const std::vector<double>& p,
                            const std::vector<std::string>& exclude, int most_causes);

}  // namespace ident
