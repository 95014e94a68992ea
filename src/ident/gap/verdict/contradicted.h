// Constants of the bench that the flight contradicts: findings beside the causes.
#pragma once

#include <string>
#include <vector>

#include "ident/result/result.h"

namespace ident {

struct Contradiction {
  std::string constant, unit;
  double stated = kNaN, found = kNaN, std = kNaN;
  double deviations = 0;  ///< between them, of both together
};

/// Those beyond chance of which the flight tells something, the furthest first. `causes`: a constant that is
/// named as a cause itself (parameter:kT) is not said twice.
std::vector<Contradiction> contradictions(const std::vector<Parameter>& fitted,
                                          const std::vector<std::string>& causes);

/// "km is 820 +- 4 rad/s, not 761 (17 standard deviations)".
std::string in_words(const Contradiction& one);

}  // namespace ident
