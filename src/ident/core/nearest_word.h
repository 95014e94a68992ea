// The word a user probably meant: for messages about a mistyped name.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ident {

/// The candidate nearest to `word` (edit distance, swapped neighbours count once), or an empty string when
/// none is near enough to be a typing error.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'thrust'?", or an empty string.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace ident
