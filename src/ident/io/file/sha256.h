// The SHA-256 of a text or a file, so that a stranger can tell whether he has the same input.
#pragma once

#include <string>
#include <string_view>

namespace ident {

/// Hash as 64 hexadecimal digits [FIPS 180-4].
std::string sha256(std::string_view bytes);

/// Hash of a file; throws InputError when it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace ident
