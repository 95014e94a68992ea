// Blackbox logs of real flights against the digests of blackbox_decode's output.
#include <filesystem>

#include "ident/io/blackbox/blackbox_format.h"
#include "support/log_digest.h"
#include "support/real_data.h"

namespace ident {
namespace {

TEST(BlackboxReader, NoCellDiffersFromBlackboxDecode) {
  IDENT_NEEDS_REAL_DATA(folder);
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/logs/betaflight")) {
    const std::string path = entry.path().string();
    if (path.ends_with(".json")) continue;
    SCOPED_TRACE(path);
    const LogStreams streams = BlackboxFormat::read(bytes_of(path), path);
    const nlohmann::json digest = nlohmann::json::parse(std::ifstream(path + ".json"));
    for (const auto& [log, fields] : digest.at("logs").items()) {
      const LogStream* main = streams.find(std::to_string(std::stoi(log)) + ":main");
      ASSERT_TRUE(main) << log;
      EXPECT_EQ(digest_differences(*main, fields), 0);
    }
    ++files;
  }
  EXPECT_EQ(files, 4);
}

}  // namespace
}  // namespace ident
