// Each encoding against bytes made by hand from its bit layout, as firmware's blackbox_encoding.c documents
// it.
#include "ident/io/blackbox/encodings.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace ident::blackbox {
namespace {

ByteSource source(const std::vector<std::uint8_t>& bytes) { return {.bytes = bytes}; }

std::vector<std::int32_t> first(const Group& group, std::size_t count) {
  return {group.begin(), group.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(BlackboxEncodings, VariableBytesHoldSevenBitsEachLowestFirst) {
  // 300 = 10 0101100b; zigzag: 1 is -1, 2 is 1; 0xffffffff is the lowest number.
  const std::vector<std::uint8_t> bytes{0x7f, 0xac, 0x02, 0x01, 0x02, 0xff, 0xff, 0xff, 0xff, 0x0f};
  ByteSource in = source(bytes);
  EXPECT_EQ(in.unsigned_vb(), 127u);
  EXPECT_EQ(in.unsigned_vb(), 300u);
  EXPECT_EQ(in.signed_vb(), -1);
  EXPECT_EQ(in.signed_vb(), 1);
  EXPECT_EQ(in.signed_vb(), std::numeric_limits<std::int32_t>::min());
  EXPECT_FALSE(in.past_end);
  EXPECT_EQ(in.unsigned_vb(), 0u);
  EXPECT_TRUE(in.past_end);
}

TEST(BlackboxEncodings, NegativeOf14BitsKeepsItsSign) {
  // The battery's deviation is stored negated: 5 means -5, 0x3fff is -1 in 14 bits and means 1.
  const std::vector<std::uint8_t> bytes{0x05, 0xff, 0x7f};
  ByteSource in = source(bytes);
  EXPECT_EQ(read_negative_14_bit(in), -5);
  EXPECT_EQ(read_negative_14_bit(in), 1);
}

TEST(BlackboxEncodings, Tag8Of8StoresOnlyWhatTheTagNames) {
  // Tag 00000101b: the first and third of four, 1 (zigzag 2) and -2 (zigzag 3).
  const std::vector<std::uint8_t> bytes{0x05, 0x02, 0x03, 0x02};
  ByteSource in = source(bytes);
  Group group{};
  read_tag8_8svb(in, 4, group);
  EXPECT_EQ(first(group, 4), (std::vector<std::int32_t>{1, 0, -2, 0}));
  read_tag8_8svb(in, 1, group);  // alone it has no tag
  EXPECT_EQ(group[0], 1);
}

TEST(BlackboxEncodings, Tag2Of3HasFourWidths) {
  const std::vector<std::uint8_t> bytes{
      0b00'01'11'10,                                              // 2 bits: 1, -1, -2
      0b01'00'0111,  0b1000'1111,                                 // 4 bits: 7, -8, -1
      0b10'011111,   0b00'100000, 0x3f,                           // 6 bits: 31, -32, -1
      0b11'10'01'00, 0x80,        0x34, 0x12, 0x56, 0x34, 0x92,   // 8, 16, 24 bits
      0b11'00'00'11, 0x01,        0x00, 0x00, 0x80, 0x02, 0x03};  // 32, 8, 8 bits
  ByteSource in = source(bytes);
  Group group{};
  read_tag2_3s32(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{1, -1, -2}));
  read_tag2_3s32(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{7, -8, -1}));
  read_tag2_3s32(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{31, -32, -1}));
  read_tag2_3s32(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{-128, 0x1234, 0x923456 - 0x1000000}));
  read_tag2_3s32(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{1 - 0x7fffffff - 1, 2, 3}));
  EXPECT_EQ(in.at, bytes.size());
}

TEST(BlackboxEncodings, Tag2Of3VariableHas554And877Bits) {
  // ss11 1112 2222 3333: 15, -16, 7. ss11 1111 1122 2222 2333 3333: -100, 63, -64.
  const std::vector<std::uint8_t> bytes{0b01'01111'1, 0b0000'0111, 0b10'100111, 0b00'011111, 0b1'1000000};
  ByteSource in = source(bytes);
  Group group{};
  read_tag2_3s_variable(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{15, -16, 7}));
  read_tag2_3s_variable(in, group);
  EXPECT_EQ(first(group, 3), (std::vector<std::int32_t>{-100, 63, -64}));
}

TEST(BlackboxEncodings, Tag8Of4RunsNibblesOnInVersion2) {
  // Widths 4, 8, 16, 4 bits: 0x7, 0x9a, 0x1234, 0xf and a nibble to spare, big endian throughout.
  const std::vector<std::uint8_t> bytes{0b01'11'10'01, 0x79, 0xa1, 0x23, 0x4f};
  ByteSource in = source(bytes);
  Group group{};
  read_tag8_4s16_v2(in, group);
  EXPECT_EQ(first(group, 4), (std::vector<std::int32_t>{7, 0x9a - 0x100, 0x1234, -1}));
  EXPECT_EQ(in.at, bytes.size());
}

TEST(BlackboxEncodings, Tag8Of4PairsNibblesInVersion1) {
  // Two numbers of 4 bits share a byte, the first in its lower half; 8 bits; 16 bits little endian.
  const std::vector<std::uint8_t> bytes{0b11'10'01'01, 0x87, 0xff, 0x34, 0x12};
  ByteSource in = source(bytes);
  Group group{};
  read_tag8_4s16_v1(in, group);
  EXPECT_EQ(first(group, 4), (std::vector<std::int32_t>{7, -8, -1, 0x1234}));
}

}  // namespace
}  // namespace ident::blackbox
