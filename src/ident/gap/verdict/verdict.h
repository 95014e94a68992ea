// What is said of a gap: which causes are there, what else could be in their place, and what is left.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/verdict/contradicted.h"
#include "ident/gap/verdict/discrepancy.h"
#include "ident/gap/verdict/right_name.h"

namespace ident {

/// A cause found, and whether it is it.
struct JudgedCause {
  NameEvidence evidence;
  double in_sets = 0;  ///< probability that it is in the set, by equation (5)
  double right = 0;    ///< that no cause outside the catalogue does its work, by (8)
  Share share;         ///< of the gap
  double probability() const { return in_sets * right; }
};

struct Judged {
  std::string status, sentence;
  std::vector<std::string> effects, confused_with;
  std::vector<std::string> minor;       ///< certain, and together too small a part of the gap to be named
  std::vector<JudgedCause> causes;      ///< all that were found, named or not
  Share remaining;                      ///< of the gap, by what the causes named do not close
  Discrepancy rest;                     ///< what else is there
  std::vector<Contradiction> findings;  ///< constants that the flight contradicts, beside the causes
};

/// All that a verdict rests on.
struct Seen {
  const SearchResult& search;
  const GapClosed& gap;
  const GapShares& shares;
  const Rival& rival;
  const std::vector<SpectralLine>& lines;
  const std::vector<Burst>& jumps;
  const std::vector<Unsteady>& unsteady;
  const std::vector<Parameter>& fitted;
  bool by_side = false;  ///< shares are of forces or of moments, whichever the causes act on
};

Judged judge(const Seen& seen);

/// The verdict `unknown` of which nothing is named: what was, is among the nearest.
Judged unnamed(Judged verdict);

/// The same of these causes only; `unknown` where none of the others is named.
Judged unnamed(Judged verdict, const std::vector<std::string>& causes);

}  // namespace ident
