// Blackbox logs of real flights against the digests of blackbox_decode's output.
#include <filesystem>

#include "ident/io/blackbox/format.h"
#include "ident/result/result.h"
#include "support/log_digest.h"
#include "support/mangled.h"
#include "support/real_data_folder.h"

namespace ident {
namespace {

std::vector<std::string> samples(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/logs/betaflight"))
    if (!entry.path().string().ends_with(".json")) paths.push_back(entry.path().string());
  return paths;
}

TEST(BlackboxReader, NoCellDiffersFromBlackboxDecode) {
  IDENT_NEEDS_REAL_DATA(folder);
  ASSERT_EQ(samples(folder).size(), 4u);
  for (const std::string& path : samples(folder)) {
    SCOPED_TRACE(path);
    const LogStreams streams = BlackboxFormat::read(bytes_of(path), path);
    const nlohmann::json digest = nlohmann::json::parse(std::ifstream(path + ".json"));
    for (const auto& [log, fields] : digest.at("logs").items()) {
      const LogStream* main = streams.find(std::to_string(std::stoi(log)) + ":main");
      ASSERT_TRUE(main) << log;
      EXPECT_EQ(digest_differences(*main, fields), 0);
    }
  }
}

/// Every column of a stream is as long as its times.
void expect_even_columns(const LogStreams& streams) {
  for (const LogStream& stream : streams.streams)
    for (const StreamField& field : stream.fields) ASSERT_EQ(field.size(), stream.t.size()) << stream.name;
}

TEST(BlackboxReader, PrefixesAndFlippedBitsOfSamplesAreReadOrRefusedInTime) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const std::string& path : samples(folder)) {
    SCOPED_TRACE(path);
    const std::string bytes = bytes_of(path);
    const auto read = [&](std::string_view damaged) {
      expect_even_columns(BlackboxFormat::read(damaged, path));
    };
    const double whole = seconds_of([&] { read(bytes); });
    const std::size_t tries = bytes.size() < 10'000 ? bytes.size() : 40;
    const double all = seconds_of([&] { read_prefixes(bytes, tries, read); });
    EXPECT_LT(all, 5.0 * static_cast<double>(tries) * whole + 1.0);
    const int flips = bytes.size() < 10'000 ? 2000 : 40;
    const double flipped = seconds_of([&] { read_with_flipped_bits(bytes, 4000, flips, read); });
    EXPECT_LT(flipped, 5.0 * flips * whole + 1.0);
  }
}

}  // namespace
}  // namespace ident
