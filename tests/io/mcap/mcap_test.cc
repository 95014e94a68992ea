// MCAP files written by hand: chunks of each kind, damage, topics that cannot be read.
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include "ident/core/error.h"
#include "ident/io/mcap/format.h"
#include "ident/io/packed/crc32.h"
#include "support/bag_bytes.h"

namespace ident {
namespace {

const std::string opening =
    mcap_schema(1, "test_msgs/msg/Count", "ros2msg", "uint8 a\nfloat64 b\n") + mcap_channel(7, 1, "/count");

std::string count_message(int i) {
  return mcap_message(7, 1'000'000'000u + 10'000'000u * static_cast<std::uint64_t>(i),
                      CdrText().number(static_cast<std::uint8_t>(i)).number(0.5 * i).bytes());
}

/// A chunk of ten messages; `pack` gives the bytes as they are stored.
template <typename Pack>
std::string chunk(const std::string& compression, Pack pack, std::uint32_t wrong = 0) {
  std::string records = opening;
  for (int i = 0; i < 10; ++i) records += count_message(i);
  const std::string packed = pack(records);
  return mcap_record(6, little_endian<std::uint64_t>(0) + little_endian<std::uint64_t>(0) +
                            little_endian<std::uint64_t>(records.size()) +
                            little_endian(crc32(records) + wrong) + mcap_string(compression) +
                            little_endian<std::uint64_t>(packed.size()) + packed);
}

std::string as_it_is(const std::string& records) { return records; }

std::string lz4(const std::string& records) {
  std::string packed(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  return packed;
}

std::string zstd(const std::string& records) {
  std::string packed(ZSTD_compressBound(records.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), 3));
  return packed;
}

void expect_ten_counts(const LogStreams& log) {
  const LogStream* count = log.find("/count");
  ASSERT_TRUE(count);
  ASSERT_EQ(count->t.size(), 10u);
  EXPECT_NEAR(count->t[9], 0.09, 1e-12);
  EXPECT_EQ(count->find("a")->at(9), 9.0);
  EXPECT_EQ(count->find("b")->at(9), 4.5);
  EXPECT_TRUE(std::holds_alternative<std::vector<std::uint8_t>>(count->find("a")->values));
}

TEST(McapReader, UnpacksChunksOfEveryKind) {
  for (const std::string& records : {chunk("", as_it_is), chunk("lz4", lz4), chunk("zstd", zstd)}) {
    const LogStreams log = McapFormat::read(mcap_file(records), "bag");
    expect_ten_counts(log);
    EXPECT_TRUE(log.damage.empty());
  }
}

TEST(McapReader, TakesWhatIsThereOfAFileThatWasCutOff) {
  for (const std::string& records : {chunk("", as_it_is), chunk("lz4", lz4), chunk("zstd", zstd)}) {
    const std::string file = mcap_file(chunk("", as_it_is) + records);
    const LogStreams log = McapFormat::read(file.substr(0, file.size() - 60), "bag");
    EXPECT_GE(log.find("/count")->t.size(), 10u);
    EXPECT_LT(log.find("/count")->t.size(), 20u);
    EXPECT_FALSE(log.damage.empty());
  }
}

TEST(McapReader, LeavesOutAChunkThatDoesNotHaveItsChecksum) {
  const LogStreams log = McapFormat::read(mcap_file(chunk("zstd", zstd) + chunk("zstd", zstd, 1)), "bag");
  expect_ten_counts(log);
  ASSERT_EQ(log.damage.size(), 1u);
  EXPECT_NE(log.damage[0].find("checksum"), std::string::npos);
}

TEST(McapReader, NamesTheTopicsThatItCannotRead) {
  const std::string others =
      mcap_schema(2, "Foo", "protobuf", "x") + mcap_channel(8, 2, "/proto", "protobuf") +
      mcap_schema(3, "a/msg/B", "ros2msg", "c/D d\n") + mcap_channel(9, 3, "/undefined") +
      mcap_message(9, 1, CdrText().number(1.0).bytes());
  const LogStreams log = McapFormat::read(mcap_file(chunk("", as_it_is) + others), "bag");
  expect_ten_counts(log);
  ASSERT_EQ(log.damage.size(), 2u);
  EXPECT_EQ(log.damage[0], "topic /proto is not read: its messages are encoded as protobuf");
  EXPECT_EQ(log.damage[1], "topic /undefined (a/msg/B) is not read: type c/D is not defined");
}

TEST(McapReader, RefusesAFileInWhichNothingCanBeRead) {
  EXPECT_THROW(McapFormat::read(mcap_file(""), "bag"), InputError);
  EXPECT_THROW(McapFormat::read("\x89MCAP0\r\n", "bag"), InputError);
  EXPECT_THROW(McapFormat::read("MCAP", "bag"), InputError);
}

TEST(McapReader, DoesNotFillTheMemoryWithAChunkThatClaimsToBeLarge) {
  const std::string packed = zstd(std::string(100, 'x'));
  const std::string huge =
      mcap_record(6, std::string(16, '\0') + little_endian<std::uint64_t>(std::uint64_t{1} << 60) +
                         little_endian<std::uint32_t>(0) + mcap_string("zstd") +
                         little_endian<std::uint64_t>(packed.size()) + packed);
  expect_ten_counts(McapFormat::read(mcap_file(huge + chunk("", as_it_is)), "bag"));
}

}  // namespace
}  // namespace ident
