// The texts of data/profiles, which the build embeds in the library.
#pragma once

#include <span>
#include <string_view>

namespace ident {

/// A file of data/profiles, which is part of the library.
struct ProfileText {
  std::string_view name, text;
};
std::span<const ProfileText> profile_texts();

}  // namespace ident
