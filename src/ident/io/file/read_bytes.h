// A small file as a whole, for the formats that are read that way.
#pragma once

#include <string>
#include <string_view>

namespace ident {

/// All bytes of a file without a byte order mark. Throws InputError when it cannot be read, is larger than
/// `limit`, is no regular text (NUL bytes) or is a git-LFS pointer.
std::string read_bytes(const std::string& path, std::size_t limit);

/// The byte order mark that a file begins with, or nothing: it is no part of the text, and a file that is
/// written anew keeps it.
std::string byte_order_mark(const std::string& path);

/// Throws InputError when these first bytes of a file are a git-LFS pointer, UTF-16 or binary.
void refuse_no_text(const std::string& path, std::string_view first_bytes);

}  // namespace ident
