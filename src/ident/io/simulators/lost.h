// Compares a vehicle with what a simulator's file holds of it; an effect says itself what will be missing.
#pragma once

#include "ident/io/simulators/reduced.h"

namespace ident {

/// What the reduced vehicle lacks of the whole one, one sentence each, in the user's words.
std::vector<std::string> lost(const Vehicle& vehicle, const Capacity& holds, std::string_view target);

}  // namespace ident
