// The variable-length encodings of blackbox_encoding.c.
#pragma once

#include <span>

#include "bytes.h"

namespace written {

void unsigned_vb(Bytes& out, std::uint32_t value);
void signed_vb(Bytes& out, std::int32_t value);
void tag2_3s32(Bytes& out, std::span<const std::int32_t> values);  // three
void tag8_4s16(Bytes& out, std::span<const std::int32_t> values);  // four
void tag8_8svb(Bytes& out, std::span<const std::int32_t> values);  // up to eight

}  // namespace written
