// The order of the folders is the order of dependence, and every registration list matches its files both
// ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = IDENT_SOURCE_DIR;

/// A folder may include its own headers and those of the folders before it.
constexpr std::array<std::string_view, 8> kFolders{"core", "data",       "model", "effects",
                                                   "io",   "estimators", "gap",   "report"};

std::size_t rank(std::string_view folder) {
  return static_cast<std::size_t>(std::ranges::find(kFolders, folder) - kFolders.begin());
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (auto at = fs::recursive_directory_iterator(folder); at != fs::end(at); ++at) {
    if (at->path().filename() == "node_modules") at.disable_recursion_pending();
    if (endings.count(at->path().extension().string()) > 0) files.push_back(at->path());
  }
  return files;
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

TEST(Layering, IncludesGoDownTheListOfFolders) {
  for (const fs::path& file : files_below(kSource / "src/ident", {".h", ".cc", ".def"})) {
    const std::string folder = fs::relative(file, kSource / "src/ident").begin()->string();
    ASSERT_LT(rank(folder), kFolders.size()) << file << ": the folder has no place in the order";
    for (const std::string& included : matches(content(file), R"(#include "([^"]+)\")")) {
      ASSERT_TRUE(included.starts_with("ident/")) << file << " includes " << included << ", not from ident/";
      const std::string other = std::next(fs::path(included).begin())->string();
      EXPECT_LE(rank(other), rank(folder)) << file << " includes " << included << ", which is above it";
    }
  }
}

TEST(Layering, OnlyTheLeastSquaresDoorIncludesAllOfCeres) {
  for (const fs::path& file : files_below(kSource / "src/ident", {".h", ".cc"})) {
    const std::string text = content(file);
    if (text.find("#include <ceres/ceres.h>") == std::string::npos) continue;
    EXPECT_EQ(file.filename().string().rfind("least_squares", 0), 0U) << file;
  }
}

TEST(Layering, EveryFileOpensWithASentenceThatSaysWhatItIs) {
  for (const char* folder : {"src/ident", "apps", "tests"})
    for (const fs::path& file : files_below(kSource / folder, {".h", ".cc", ".def"})) {
      const std::string text = content(file);
      EXPECT_TRUE(text.starts_with("// ")) << file;
    }
}

TEST(Layering, EverySubcommandIsOneFileAndOneLine) {
  std::set<std::string> listed, written;
  for (const std::string& name :
       matches(content(kSource / "apps/commands.def"), R"(\nIDENT_COMMAND\((\w+),)"))
    listed.insert(name);
  for (const fs::path& file : files_below(kSource / "apps", {".cc"}))
    for (const std::string& name : matches(content(file), R"(\nAction (\w+)_command\()")) {
      written.insert(name);
      EXPECT_EQ(file.stem().string(), name);
    }
  EXPECT_EQ(listed, written);
}

TEST(Layering, EveryEffectIsOneFileAndOneLine) {
  std::set<std::string> listed, written;
  for (const std::string& name :
       matches(content(kSource / "src/ident/effects/effects.def"), R"(\nIDENT_EFFECT\((\w+),)"))
    listed.insert(name);
  for (const fs::path& file : files_below(kSource / "src/ident/effects", {".h"}))
    if (file.stem() != "effect" && file.stem() != "catalogue") written.insert(file.stem().string());
  EXPECT_EQ(listed, written);
}

TEST(Layering, EveryLogFormatIsOneHeaderAndOneLine) {
  std::set<std::string> listed, written;
  for (const std::string& header : matches(content(kSource / "src/ident/io/log_formats/log_formats.def"),
                                           R"(\nIDENT_LOG_FORMAT\(\w+, ([\w/]+),)"))
    listed.insert(header);
  for (const fs::path& file : files_below(kSource / "src/ident/io", {".h"}))
    if (content(file).find("static bool recognises(") != std::string::npos)
      written.insert(fs::relative(file, kSource / "src/ident/io").replace_extension().string());
  EXPECT_EQ(listed, written);
}

}  // namespace
}  // namespace ident
