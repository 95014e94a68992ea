// The MCAP reader against @mcap/core, an independent one on npm; skipped where npm or its packages are not to
// be had.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ident/io/file/whole_file.h"
#include "ident/io/mcap/format.h"
#include "ident/result/result.h"
#include "support/log_digest.h"
#include "support/real_data_folder.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

/// Folder with the oracle and its packages; empty where they cannot be installed.
fs::path installed_oracle() {
  const fs::path folder = fs::temp_directory_path() / "ident_mcap_oracle";
  fs::create_directories(folder);
  for (const char* file : {"decode.mjs", "package.json", "package-lock.json"})
    fs::copy_file(fs::path(IDENT_SOURCE_DIR) / "tests/io/mcap/oracle" / file, folder / file,
                  fs::copy_options::overwrite_existing);
  const std::string install =
      "cd '" + folder.string() + "' && npm ci --silent --no-audit --no-fund --prefer-offline >/dev/null 2>&1";
  return std::system(install.c_str()) == 0 ? folder : fs::path{};
}

TEST(McapReader, ReadsEveryNumberThatMcapCoreReads) {
  IDENT_NEEDS_REAL_DATA(data);
  const fs::path oracle = installed_oracle();
  if (oracle.empty()) GTEST_SKIP() << "npm does not install @mcap/core";
  for (const auto& entry : fs::directory_iterator(data + "/logs/mcap")) {
    const std::string path = entry.path().string();
    if (!path.ends_with(".mcap")) continue;
    SCOPED_TRACE(path);
    const fs::path output = oracle / "decoded.json";
    const std::string decode =
        "node '" + (oracle / "decode.mjs").string() + "' '" + path + "' > '" + output.string() + "'";
    ASSERT_EQ(std::system(decode.c_str()), 0);
    const nlohmann::json decoded = nlohmann::json::parse(std::ifstream(output));
    const LogStreams log = McapFormat::read(whole_file(path), path);
    EXPECT_EQ(log.streams.size(), decoded.size());
    for (const auto& [topic, digest] : decoded.items()) {
      const LogStream* stream = log.find(topic);
      ASSERT_TRUE(stream) << topic;
      EXPECT_EQ(stream->t.size(), digest.at("samples").get<std::size_t>());
      EXPECT_EQ(digest_differences(*stream, digest.at("fields")), 0);
    }
  }
}

}  // namespace
}  // namespace ident
