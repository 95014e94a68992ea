// UTF-8 well-formedness (no overlong forms, no surrogates) and Latin-1.
#include "ident/io/csv/text_encoding.h"

#include <cstdint>

namespace ident {
namespace {

/// Bytes that follow a first byte, or -1 where no character starts with it.
int following(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

bool is_scalar(std::uint32_t code, int more) {
  constexpr std::uint32_t least[] = {0, 0x80, 0x800, 0x10000};
  return code >= least[more] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

}  // namespace

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = following(first);
    if (more < 0 || text.size() - i < static_cast<std::size_t>(more)) return false;
    std::uint32_t code = more == 0 ? first : first & (0x3Fu >> more);
    for (int k = 0; k < more; ++k) {
      const auto byte = static_cast<unsigned char>(text[i++]);
      if ((byte & 0xC0) != 0x80) return false;
      code = code << 6 | (byte & 0x3Fu);
    }
    if (!is_scalar(code, more)) return false;
  }
  return true;
}

std::string latin1_to_utf8(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

}  // namespace ident
