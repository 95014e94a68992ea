// Tables as accessible HTML: a caption, scoped heads, numbers aligned on the decimal point.
#pragma once

#include <string>

#include "ident/result/result.h"

namespace ident {

/// Text of people, escaped, with raised powers.
std::string html_text(const std::string& text);

std::string html_table(const Table& table, const std::string& caption);

/// Two columns whose second is machine text that may break anywhere.
std::string verbatim_table(const Table& table);

}  // namespace ident
