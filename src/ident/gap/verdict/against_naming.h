// What speaks against naming the causes that a search found.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ident/gap/search/search_result.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/spectral_line.h"
#include "ident/result/result.h"

namespace ident {

/// The constant that the flight pulls furthest off its bench value, if too far; null if none. `excused`:
/// those that may be anywhere, by the name of the cause that they are when wrong (parameter:kT).
const Parameter* contradicted(const std::vector<Parameter>& fitted,
                              const std::function<bool(const std::string&)>& excused);

/// The first of the reasons that holds, as the end of a sentence; empty if nothing does: most of the gap
/// remains, a cause has an impossible size, a regression predicts what is left, a bench value is
/// contradicted, a constant of the vehicle changes in flight or from one channel to another, a weak cause
/// stands beside what swings or strikes, more would have to be wrong at once than go wrong, or the causes are
/// parts of a likelier one that was not tried.
std::string against_naming(const SearchResult& search, const GapClosed& gap, const Rival& rival,
                           const std::vector<SpectralLine>& lines, const std::vector<Burst>& jumps,
                           const std::vector<Parameter>& fitted);

/// A payload of which the flight shows the moment and not the mass: a shifted centre of gravity does that.
bool weightless_payload(const SearchResult& search, const std::vector<Parameter>& fitted);

}  // namespace ident
