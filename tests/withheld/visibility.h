// How visible each withheld effect is in the flights of a case.
#pragma once

#include "withheld_case.h"

namespace withheld {

constexpr std::size_t kNone = 98, kAll = 99;

// The effects of a case at their sizes, without one of its members, or without all.
Effects effects_of(const Case& c, std::size_t without = kNone);

// Fills in the sizes over the limit of the members; with the catalogue also what the other effects leave of
// them.
void measure(Case* c, bool with_catalogue);

}  // namespace withheld
