// The bytes of a file, whatever they are.
#pragma once

#include <cstddef>
#include <string>

namespace ident {

/// All bytes. Throws InputError when the file cannot be read.
std::string whole_file(const std::string& path);

/// At most the first `count` bytes; fewer, or none, where there are no more or the file cannot be read. A
/// pipe, which can be read only once, gives none.
std::string first_bytes(const std::string& path, std::size_t count);

}  // namespace ident
