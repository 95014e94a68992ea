// Bit layouts as Betaflight writes them for data version 2.
#include "blackbox_encoding.h"

namespace written {
namespace {

bool fits(std::int32_t value, int bits) { return value >= -(1 << (bits - 1)) && value < (1 << (bits - 1)); }

// Collects half bytes, the high half first.
class Nibbles {
 public:
  explicit Nibbles(Bytes& out) : out_(out) {}
  void put(int nibble) {
    if (half_)
      out_.put(static_cast<std::uint8_t>(held_ << 4 | (nibble & 0xf)));
    else
      held_ = nibble & 0xf;
    half_ = !half_;
  }
  ~Nibbles() {
    if (half_) put(0);
  }

 private:
  Bytes& out_;
  int held_ = 0;
  bool half_ = false;
};

}  // namespace

void unsigned_vb(Bytes& out, std::uint32_t value) {
  for (; value > 127; value >>= 7) out.put(static_cast<std::uint8_t>(value | 0x80));
  out.put(static_cast<std::uint8_t>(value));
}

void signed_vb(Bytes& out, std::int32_t value) {
  unsigned_vb(out, static_cast<std::uint32_t>(value) << 1 ^ static_cast<std::uint32_t>(value >> 31));
}

void tag2_3s32(Bytes& out, std::span<const std::int32_t> v) {
  const auto all_fit = [&](int bits) { return fits(v[0], bits) && fits(v[1], bits) && fits(v[2], bits); };
  if (all_fit(2)) {
    out.put(static_cast<std::uint8_t>((v[0] & 3) << 4 | (v[1] & 3) << 2 | (v[2] & 3)));
  } else if (all_fit(4)) {
    out.each<std::uint8_t>(1 << 6 | (v[0] & 0xf), (v[1] & 0xf) << 4 | (v[2] & 0xf));
  } else if (all_fit(6)) {
    out.each<std::uint8_t>(2 << 6 | (v[0] & 0x3f), v[1], v[2]);
  } else {
    int lengths[3], tag = 0;
    for (size_t i = 3; i-- > 0;) {
      lengths[i] = fits(v[i], 8) ? 1 : fits(v[i], 16) ? 2 : fits(v[i], 24) ? 3 : 4;
      tag = tag << 2 | (lengths[i] - 1);
    }
    out.put(static_cast<std::uint8_t>(3 << 6 | tag));
    for (size_t i = 0; i < 3; ++i)
      for (int byte = 0; byte < lengths[i]; ++byte) out.put(static_cast<std::uint8_t>(v[i] >> 8 * byte));
  }
}

void tag8_4s16(Bytes& out, std::span<const std::int32_t> v) {
  int nibbles[4], tag = 0;
  for (size_t i = 4; i-- > 0;) {
    const int kind = v[i] == 0 ? 0 : fits(v[i], 4) ? 1 : fits(v[i], 8) ? 2 : 3;
    nibbles[i] = kind == 3 ? 4 : kind;
    tag = tag << 2 | kind;
  }
  out.put(static_cast<std::uint8_t>(tag));
  Nibbles packed(out);
  for (size_t i = 0; i < 4; ++i)
    for (int n = nibbles[i] - 1; n >= 0; --n) packed.put(v[i] >> 4 * n);
}

void tag8_8svb(Bytes& out, std::span<const std::int32_t> v) {
  if (v.size() == 1) return signed_vb(out, v[0]);
  int tag = 0;
  for (size_t i = 0; i < v.size(); ++i) tag |= (v[i] != 0) << i;
  out.put(static_cast<std::uint8_t>(tag));
  for (const std::int32_t value : v)
    if (value != 0) signed_vb(out, value);
}

}  // namespace written
