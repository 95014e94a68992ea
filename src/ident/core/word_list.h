// Lists within a sentence.
#pragma once

#include <string>
#include <vector>

namespace ident {

/// "a", "a and b", "a, b and c"; empty for none.
std::string listed(const std::vector<std::string>& words);

}  // namespace ident
