// What speaks against naming the causes that a search found.
#pragma once

#include <string>
#include <vector>

#include "ident/core/result.h"
#include "ident/gap/generic_rival.h"
#include "ident/gap/model_search.h"

namespace ident {

/// The constant that the flight, with the causes found, pulls furthest off its bench value, if too far. One
/// whose value is among those causes may be anywhere.
const Parameter* contradicted(const std::vector<Parameter>& fitted, const std::vector<Candidate>& adopted);

/// The first of the reasons that holds, as the end of a sentence; empty if nothing does: most of the gap
/// remains, a regression predicts what is left, a bench value is contradicted, a constant of the vehicle
/// changes in flight, or the causes are parts of a likelier one that was not tried.
std::string against_naming(const SearchResult& search, const GapClosed& gap, const Rival& rival,
                           const std::vector<Parameter>& fitted);

/// A payload of which the flight shows the moment and not the mass: a shifted centre of gravity does that.
bool weightless_payload(const SearchResult& search, const std::vector<Parameter>& fitted);

}  // namespace ident
