// Whether a cause that was found is it, or stands in for what the catalogue lacks.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/evidence/shares.h"
#include "ident/gap/search/search_result.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/result/result.h"

namespace ident {

/// The quantities of equation (8), for one name.
struct NameEvidence {
  std::string name;
  double left = 0;    ///< log10 of the regression's gain over chance and what forms leave to it; -2 to 2
  double varies = 0;  ///< log10 of how far its size differs beyond chance, over what its form allows; -2 to 1
  double closes = 0;  ///< lower end of what all causes close of the held-out gap, 0 to 1
  double told = 0;    ///< log10 of its fall of the cost
  double minor = 0;   ///< log10 of that over the fall by the strongest cause found; 0 or less
  double share = 0;   ///< upper end of its own share of the gap, 0 to 1; 1 where there is none
  double beyond = 0;  ///< logarithm of its size over the limit of physics, 0 within
  bool told_from_none = true;
  double beside_left_out = 1;  ///< probability that it is there beside causes that were left out as asked
  bool seen = false;           ///< thrust over voltage shows it without any model
};

struct NamesSeen {
  const SearchResult& search;
  const GapShares& shares;
  const Rival& rival;
  const std::vector<Parameter>& fitted;
};

/// What the forms of the causes found leave to a regression, as a fall of the cost.
double left_by_form(const SearchResult& search);

NameEvidence evidence_of(const std::string& name, const NamesSeen& seen);

/// Probability that it is right, given that the flight speaks for it.
double probability_right(const NameEvidence& x);

}  // namespace ident
