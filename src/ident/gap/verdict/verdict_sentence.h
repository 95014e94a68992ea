// A verdict in words: one sentence that a pilot understands, then the numbers.
#pragma once

#include <string>

#include "ident/gap/verdict/verdict.h"

namespace ident {

std::string sentence_of(const Judged& verdict, const Seen& seen);

}  // namespace ident
