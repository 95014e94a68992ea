// Which cause a search looks at next.
#pragma once

#include <functional>
#include <vector>

#include "ident/gap/search/further.h"

namespace ident {

struct NextCause {
  /// Explains enough to be adopted, and has most evidence under a stretch that is common to all that do.
  Further best;
  /// Gains most of those not yet tried in full; by its size, that seems to change from block to block or to
  /// lie beyond what physics allows, it cannot be judged where it is linearised.
  Further uneven;
};

/// Of the causes that the model does not have: none of `barred`, and for a trial in full none of `tried`.
NextCause next_cause(const Standing& at, const std::function<bool(int)>& barred,
                     const std::vector<Candidate>& tried);

/// Whether a cause that passes is looked for beside `found` others, which gain `explained` in all: what is
/// left of causes of nearly the right form gets names otherwise.
bool is_material(const Further& next, const Candidate& cause, int found, double explained);

}  // namespace ident
