// The rotor speed of a bench file: which of its columns to trust, and whether they agree.
#pragma once

#include <string>
#include <vector>

#include "ident/data/table.h"

namespace ident {

constexpr std::size_t kFewestTurning = 3;  ///< samples off zero that make a column usable

/// `omega` is preferred, then the optical speed, then the electrical one: an electrical speed hangs on the
/// number of poles. Two speeds that are there are compared: a small integer ratio is a wrong number of poles
/// (or of marks) and warned of as `pole_count`. Null when none is usable.
const Column* speed_column(const NumberTable& table, std::vector<Warning>& warnings);

/// What each speed column holds, for a message.
std::string speed_columns_in_words(const NumberTable& table);

/// p and q up to `largest` with p/q within `tolerance` (relative) of the ratio and p + q least; {0, 0} if
/// there is none.
struct SmallRatio {
  int p = 0, q = 0;
};
SmallRatio small_ratio(double ratio, int largest, double tolerance);

}  // namespace ident
