// A true cause has one size: in every part of the flight, and in every channel.
#pragma once

#include <string>

#include "ident/gap/search/search_result.h"

namespace ident {

/// What motors do follows its equation only nearly; what air, ground and battery do, less than that.
bool is_of_motors(const Candidate& cause);
bool is_of_drive(const std::string& cause);
bool is_loose(const Candidate& cause);

/// The cause found whose value changes from one part of the flight to the next though it should not: another
/// one acts there in its place. Null where there is none.
const Candidate* changing(const SearchResult& search);

/// The cause found of which one channel, named in `part`, asks for another size than the others do: another
/// one acts there. Null where there is none.
const Candidate* at_odds(const SearchResult& search, std::string& part);

}  // namespace ident
