// The weights of alternative sets of causes at the model that a search found.
#pragma once

#include "ident/gap/hypotheses/next_model.h"

namespace ident {

/// Log prior odds against each further cause.
inline constexpr double kOddsAgainst = 7.0;

/// Weight of a set of causes.
struct WeighedSet {
  std::vector<int> members;
  double log_evidence = 0.0;
  double probability = 0.0;
};

/// Log odds of one set of causes against another where a search stands.
double log_odds(const Standing& at, const std::vector<int>& one, const std::vector<int>& other);

/// Sets of at most two causes, the one found, and those with one of its members exchanged: most probable
/// first.
std::vector<WeighedSet> weighed_sets(const Standing& found);

}  // namespace ident
