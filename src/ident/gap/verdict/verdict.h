// What is said of a gap: named, ambiguous, unknown or none.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/search/search_result.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/spectral_line.h"

namespace ident {

struct Judged {
  std::string status, sentence;
  std::vector<std::string> effects, confused_with;
  double remaining = kNaN;
  /// What is named is there whatever else is; the rest is not explained.
  bool plain = false;
  /// Causes were found and not named: something about them is not as it is with true ones. How often the
  /// nearest is there all the same, among flights of which that was known.
  bool refused = false;
  static constexpr double kNearestIsThere = 0.3;
};

/// From the search, the share closed on held-out flight by horizon (s), and what no cause of the catalogue
/// can do.
Judged judge(const SearchResult& search, const GapClosed& gap, const Rival& rival,
             const std::vector<SpectralLine>& lines, const std::vector<Burst>& jumps,
             const std::vector<Parameter>& fitted);

/// The verdict `unknown` of which nothing is named: what was, is among the nearest.
Judged unnamed(Judged verdict);

/// As `verdict` of a result.
nlohmann::ordered_json to_json(const Judged& verdict);

}  // namespace ident
