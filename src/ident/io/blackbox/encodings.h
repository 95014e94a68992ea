// The encodings of blackbox fields: how a number, or a group of numbers, lies in a frame.
#pragma once

#include <array>
#include <cstdint>

#include "ident/io/blackbox/byte_source.h"

namespace ident::blackbox {

/// Numbers as in the header lines `H Field I encoding:`.
enum class Encoding : std::uint8_t {
  signed_vb = 0,
  unsigned_vb = 1,
  negative_14_bit = 3,
  tag8_8svb = 6,
  tag2_3s32 = 7,
  tag8_4s16 = 8,
  null = 9,
  tag2_3s_variable = 10,
};

/// Values of one group; only as many as the group has are set.
using Group = std::array<std::int32_t, 8>;

/// False for the Elias codes (4, 5, 11) of old drafts, which no firmware writes.
bool is_known_encoding(int number);
/// Fields that the encoding stores at once; 0 for tag8_8svb, which takes as many neighbours as there are, up
/// to 8.
int fields_of_group(Encoding encoding);

std::int32_t read_negative_14_bit(ByteSource& in);
/// `count` numbers, each present if its bit of the first byte is set; a single one without that byte.
void read_tag8_8svb(ByteSource& in, int count, Group& values);
void read_tag2_3s32(ByteSource& in, Group& values);
void read_tag2_3s_variable(ByteSource& in, Group& values);
/// Data version 1 pairs nibbles differently from version 2 (big endian, nibbles run on).
void read_tag8_4s16_v1(ByteSource& in, Group& values);
void read_tag8_4s16_v2(ByteSource& in, Group& values);

}  // namespace ident::blackbox
