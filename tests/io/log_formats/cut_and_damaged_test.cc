// Logs that are cut or damaged anywhere are read as far as they go, or refused with a sentence.
#include <gtest/gtest.h>

#include <random>

#include "ident/core/error.h"
#include "ident/io/file/whole_file.h"
#include "ident/io/log_formats/read_log_streams.h"
#include "support/log_samples.h"

namespace ident {
namespace {

/// All columns of a stream have its length, whatever the bytes were.
void expect_consistent(const LogStreams& log) {
  for (const LogStream& stream : log.streams)
    for (const StreamField& field : stream.fields)
      ASSERT_TRUE(stream.t.empty() || field.size() == stream.t.size()) << stream.name << " " << field.name;
}

void read_or_refuse(std::string_view bytes) {
  try {
    expect_consistent(read_log_streams(bytes, "log"));
  } catch (const InputError& error) {
    EXPECT_GT(std::string(error.what()).size(), 10U);
  }
}

constexpr std::size_t kEveryPrefixBelow = 3000;  // bytes; the definitions of all formats begin there
constexpr int kSampled = 300;

class CutAndDamaged : public ::testing::TestWithParam<std::string> {};

TEST_P(CutAndDamaged, PrefixesAreReadOrRefused) {
  IDENT_NEEDS_LOG_SAMPLE(path, GetParam());
  const std::string bytes = whole_file(path);
  for (std::size_t n = 0; n < std::min(kEveryPrefixBelow, bytes.size()); n += 7)
    read_or_refuse(std::string_view(bytes).substr(0, n));
  std::mt19937_64 random(1);
  for (int i = 0; i < kSampled / 10; ++i)
    read_or_refuse(std::string_view(bytes).substr(0, random() % bytes.size()));
}

TEST_P(CutAndDamaged, DamagedBytesAreReadOverOrRefused) {
  IDENT_NEEDS_LOG_SAMPLE(path, GetParam());
  const std::string whole = whole_file(path).substr(0, 200000);
  std::mt19937_64 random(2);
  for (int i = 0; i < kSampled; ++i) {
    std::string bytes = whole;
    const std::size_t from = random() % bytes.size(),
                      count = std::min<std::size_t>(1 + random() % 64, bytes.size() - from);
    for (std::size_t k = 0; k < count; ++k) bytes[from + k] = static_cast<char>(random());
    read_or_refuse(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(OfSamples, CutAndDamaged,
                         ::testing::Values("ulog/mcap__test_ulog.ulg", "ulog/pyulog__sample_log_small.ulg",
                                           "dataflash/pymavlink__test.BIN", "crazyflie/imrclab__log178",
                                           "betaflight/error-recovery.bbl",
                                           "betaflight/fc-blackbox__btfl_001.bbl",
                                           "mcap/cognipilot_cubs2__cub_stabilize_2025_11_13.mcap",
                                           "mcap/rosbag2__wbag_0.mcap"),
                         [](const auto& sample) {
                           std::string name = sample.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

/// Found by the fuzzer: a format that makes the number of a unit a double, out of the range of any integer.
TEST(DamagedDataflash, UnitWithoutANumberOfOneByteIsPassedOver) {
  const auto message = [](std::string body, std::size_t size) {
    body.resize(size, '\0');
    return "\xA3\x95" + body;
  };
  std::string bytes = message("\x80\x06\x0BUNITd", 87);
  bytes.replace(2 + 1 + 2 + 4 + 16, 2, "Id");
  bytes += message("\x06\xFF\xFF\xFF\xFF\xFF\xFF\xEF\x7F", 9);  // 1.8e308
  EXPECT_NO_THROW(read_log_streams(bytes, "log"));
}

TEST(Refusals, NameWhatTheFileIsAndWhatToDo) {
  const auto expect = [](std::string_view bytes, const char* words) {
    try {
      read_log_streams(bytes, "flight");
      ADD_FAILURE() << words << ": was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  expect("\x1F\x8B\x08", "gunzip");
  expect("PK\x03\x04", "unzip");
  expect("\x28\xB5\x2F\xFD", "unzstd");
  expect(
      "\xFD"
      "7zXZ",
      "unxz");
  expect("BZh9", "bunzip2");
  expect("version https://git-lfs.github.com/spec/v1\n", "git lfs pull");
  // 2020-09-13 12:26:40 UTC in microseconds, big endian, and a packet of MAVLink 2.
  expect(std::string_view("\x00\x05\xAF\x31\x07\xA4\x00\x00\xFD\x09", 10), "vehicle's card");
  expect("hello", "no format of a log");
  expect("", "no format of a log");
}

}  // namespace
}  // namespace ident
