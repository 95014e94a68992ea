// Text of a number to its value: the whole text, no locale, correct rounding.
#pragma once

#include <optional>
#include <string_view>

namespace ident {

/// Value of a decimal number with nothing around it but blanks; infinite for `inf` and for what does not fit,
/// NaN for `nan`, empty for everything else (hexadecimal, words, `1,5`, an empty text).
std::optional<double> parse_number(std::string_view text);

}  // namespace ident
