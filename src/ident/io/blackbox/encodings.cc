// The encodings of blackbox fields: how a number, or a group of numbers, lies in a frame.
#include "ident/io/blackbox/encodings.h"

namespace ident::blackbox {

namespace {

/// The lowest `bits` of a number, with its sign.
template <int bits>
std::int32_t sign_extend(std::uint32_t value) {
  return static_cast<std::int32_t>(value << (32 - bits)) >> (32 - bits);
}

/// Little-endian integer of 1 to 4 bytes.
std::int32_t read_little_endian(ByteSource& in, unsigned n_bytes) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < n_bytes; ++i) value |= static_cast<std::uint32_t>(in.byte()) << (8 * i);
  const unsigned unused = 32 - 8 * n_bytes;
  return static_cast<std::int32_t>(value << unused) >> unused;
}

/// The widths in bytes of three numbers, two bits each, the first in the lowest bits.
void read_three_by_width(ByteSource& in, unsigned widths, Group& values) {
  for (std::size_t i = 0; i < 3; ++i, widths >>= 2) values[i] = read_little_endian(in, (widths & 3u) + 1);
}

}  // namespace

bool is_known_encoding(int number) {
  switch (number) {
    case 0:
    case 1:
    case 3:
    case 6:
    case 7:
    case 8:
    case 9:
    case 10:
      return true;
    default:
      return false;
  }
}

int fields_of_group(Encoding encoding) {
  switch (encoding) {
    case Encoding::tag8_8svb:
      return 0;
    case Encoding::tag2_3s32:
    case Encoding::tag2_3s_variable:
      return 3;
    case Encoding::tag8_4s16:
      return 4;
    default:
      return 1;
  }
}

std::int32_t read_negative_14_bit(ByteSource& in) { return -sign_extend<14>(in.unsigned_vb()); }

void read_tag8_8svb(ByteSource& in, int count, Group& values) {
  if (count == 1) {
    values[0] = in.signed_vb();
    return;
  }
  unsigned present = in.byte();
  for (std::size_t i = 0; i < 8; ++i, present >>= 1) values[i] = (present & 1u) != 0 ? in.signed_vb() : 0;
}

void read_tag2_3s32(ByteSource& in, Group& values) {
  const std::uint32_t lead = in.byte();
  switch (lead >> 6) {
    case 0:
      values[0] = sign_extend<2>(lead >> 4);
      values[1] = sign_extend<2>(lead >> 2);
      values[2] = sign_extend<2>(lead);
      break;
    case 1: {
      const std::uint32_t second = in.byte();
      values[0] = sign_extend<4>(lead);
      values[1] = sign_extend<4>(second >> 4);
      values[2] = sign_extend<4>(second);
      break;
    }
    case 2:
      values[0] = sign_extend<6>(lead);
      values[1] = sign_extend<6>(in.byte());
      values[2] = sign_extend<6>(in.byte());
      break;
    default:
      read_three_by_width(in, lead, values);
  }
}

void read_tag2_3s_variable(ByteSource& in, Group& values) {
  const std::uint32_t lead = in.byte();
  switch (lead >> 6) {
    case 0:
      values[0] = sign_extend<2>(lead >> 4);
      values[1] = sign_extend<2>(lead >> 2);
      values[2] = sign_extend<2>(lead);
      break;
    case 1: {  // 5, 5 and 4 bits
      const std::uint32_t second = in.byte();
      values[0] = sign_extend<5>((lead & 0x3f) >> 1);
      values[1] = sign_extend<5>(((lead & 0x01) << 4) | (second >> 4));
      values[2] = sign_extend<4>(second);
      break;
    }
    case 2: {  // 8, 7 and 7 bits
      const std::uint32_t second = in.byte();
      const std::uint32_t third = in.byte();
      values[0] = sign_extend<8>(((lead & 0x3f) << 2) | (second >> 6));
      values[1] = sign_extend<7>(((second & 0x3f) << 1) | (third >> 7));
      values[2] = sign_extend<7>(third);
      break;
    }
    default:
      read_three_by_width(in, lead, values);
  }
}

void read_tag8_4s16_v1(ByteSource& in, Group& values) {
  unsigned selector = in.byte();
  for (std::size_t i = 0; i < 4; ++i, selector >>= 2) {
    switch (selector & 3u) {
      case 0:
        values[i] = 0;
        break;
      case 1: {  // two numbers of four bits share a byte
        const std::uint32_t pair = in.byte();
        values[i] = sign_extend<4>(pair);
        if (i < 3) {
          values[++i] = sign_extend<4>(pair >> 4);
          selector >>= 2;
        }
        break;
      }
      default:
        values[i] = read_little_endian(in, (selector & 3u) - 1);
    }
  }
}

void read_tag8_4s16_v2(ByteSource& in, Group& values) {
  unsigned selector = in.byte();
  std::uint32_t pending = 0;  // byte whose lower nibble was not used yet
  bool half = false;
  for (std::size_t i = 0; i < 4; ++i, selector >>= 2) {
    switch (selector & 3u) {
      case 0:
        values[i] = 0;
        break;
      case 1:
        if (!half) pending = in.byte();
        values[i] = sign_extend<4>(half ? pending : pending >> 4);
        half = !half;
        break;
      case 2: {
        const std::uint32_t next = in.byte();
        values[i] = sign_extend<8>(half ? (pending << 4) | (next >> 4) : next);
        pending = next;
        break;
      }
      default: {
        const std::uint32_t first = in.byte();
        const std::uint32_t second = in.byte();
        values[i] =
            sign_extend<16>(half ? (pending << 12) | (first << 4) | (second >> 4) : (first << 8) | second);
        pending = second;
      }
    }
  }
}

}  // namespace ident::blackbox
