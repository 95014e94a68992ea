// Whether causes found are needed beside those that were left out of the search as asked.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/hypotheses/next_model.h"

namespace ident {

/// A cause found, and how probable it is that it is there, where those left out may be there as well.
struct BesideLeftOut {
  std::string name;
  double probability = 1.0;
};

/// For each cause of the model found. `all`: where the search ended, with every cause linearised, those of
/// `left_out` included. By the weights (4) of the set found, and of each of its subsets with one or two of
/// those left out. What one of these brings along is no cause beside it.
std::vector<BesideLeftOut> beside_left_out(const Standing& all, const std::vector<std::string>& left_out);

}  // namespace ident
