// Damaged copies of a file: cut off, or with bits flipped, for readers that must read or refuse each.
#pragma once

#include <gtest/gtest.h>

#include <ctime>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "ident/core/error.h"

namespace ident {

/// Gives the reader `count` prefixes, evenly spread, of a file; all where it has fewer bytes.
template <typename Read>
void read_prefixes(std::string_view bytes, std::size_t count, Read read) {
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / count);
  for (std::size_t n = 0; n <= bytes.size(); n += step) {
    // A copy of exactly that length: the address sanitizer then sees every byte read behind it.
    const std::vector<char> prefix(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
    try {
      read(std::string_view(prefix.data(), n));
    } catch (const Error&) {
    }
  }
}

/// Gives the reader `count` copies with 1 to 16 bits flipped; a third of them within the first `head` bytes
/// only.
template <typename Read>
void read_with_flipped_bits(std::string_view bytes, std::size_t head, int count, Read read) {
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    std::string copy(bytes);
    const std::size_t range = i % 3 == 0 ? std::min(head, copy.size()) : copy.size();
    const unsigned flips = 1u + static_cast<unsigned>(random()) % 16u;
    for (unsigned k = 0; k < flips; ++k) {
      char& byte = copy[random() % range];
      byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    }
    try {
      read(std::string_view(copy));
    } catch (const Error&) {
    }
  }
}

/// Seconds of the processor that a call takes.
template <typename Call>
double seconds_of(Call call) {
  const std::clock_t begin = std::clock();
  call();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace ident
