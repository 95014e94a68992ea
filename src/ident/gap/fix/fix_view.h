// A fixed file in a result: what changed, what has no place in it, and how far the gap closes.
#pragma once

#include <string>

#include "ident/gap/fix/fixed_file.h"
#include "ident/result/result.h"

namespace ident {

/// Adds to the result of a diagnosis the JSON keys `fix` and `lost`, warnings, and a section that comes
/// first. `from` is the vehicle's file, `to` the one that is written.
void enter_fix(Result& result, const FixedFile& fixed, const std::string& from, const std::string& to);

}  // namespace ident
