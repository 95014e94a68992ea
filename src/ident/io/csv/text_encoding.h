// Which bytes a text is made of, and Latin-1 as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace ident {

bool is_utf8(std::string_view text);

std::string latin1_to_utf8(std::string_view text);

}  // namespace ident
