// A fixed file in a result: what changed, what has no place in it, and how far the gap closes.
#pragma once

#include <string>

#include "ident/gap/diagnose.h"
#include "ident/gap/fix/fixed_file.h"

namespace ident {

/// Adds to the result of the diagnosis the JSON keys `fix` and `lost`, warnings, and a section that comes
/// first. `from` is the vehicle's file, `to` the one that is written.
void enter_fix(Diagnosis& diagnosis, const FixedFile& fixed, const std::string& from, const std::string& to);

}  // namespace ident
