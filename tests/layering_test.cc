// The order of the folders is the order of dependence, and every registration list matches its files both
// ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = IDENT_SOURCE_DIR;

/// A folder may include its own headers and those of the folders before it. Prediction traces and tables of a
/// refinement (`views`) stand before `flight`, which still puts them into its result.
constexpr std::array kFolders{"core",
                              "result",
                              "data",
                              "model",
                              "effects",
                              "sim",
                              "io/file",
                              "io/csv",
                              "io/log_cleaning",
                              "io/packed",
                              "io/ros2",
                              "io/ulog",
                              "io/dataflash",
                              "io/crazyflie",
                              "io/blackbox",
                              "io/mcap",
                              "io/rosbag2",
                              "io/log_formats",
                              "io/geometry",
                              "io/rebuild",
                              "io/log",
                              "io/simulators",
                              "io/simulators/readers",
                              "io/simulators/full",
                              "io/simulators/mjcf",
                              "io/simulators/sdf",
                              "io/simulators/formats",
                              "io/vehicle",
                              "io/draft",
                              "io/campaign",
                              "fly",
                              "lsq",
                              "plots",
                              "bench/columns",
                              "bench/thrust",
                              "bench/motor",
                              "bench/inertia",
                              "bench/slant",
                              "bench/check",
                              "flight/join",
                              "flight/kernel",
                              "flight/record",
                              "flight/conditioning",
                              "flight/smoother",
                              "flight/fit",
                              "flight/trim",
                              "flight/checks",
                              "flight/ladder",
                              "views",
                              "flight",
                              "gap/hypotheses",
                              "gap/statistics",
                              "gap/search",
                              "gap/evidence",
                              "gap/windows",
                              "gap/verdict",
                              "gap/views",
                              "gap",
                              "gap/fix",
                              "gap/comparison",
                              "report"};

/// Files in a folder above which it is no topic any more.
constexpr std::size_t kMostFiles = 40;

/// Place of the folder of a path below src/ident; `core/simd` counts as `core`.
std::size_t rank(const fs::path& path) {
  std::string folder = path.parent_path().generic_string();
  if (folder == "core/simd") folder = "core";
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
    const fs::path place = fs::relative(file, kSource / "src/ident");
    ASSERT_LT(rank(place), kFolders.size()) << file << ": the folder has no place in the order";
    for (const std::string& included : matches(content(file), R"(#include "([^"]+)\")")) {
      ASSERT_TRUE(included.starts_with("ident/")) << file << " includes " << included << ", not from ident/";
      EXPECT_LE(rank(fs::relative(included, "ident")), rank(place))
          << file << " includes " << included << ", which is above it";
    }
  }
}

TEST(Layering, NoFolderHoldsMoreFilesThanOneTopicHas) {
  std::map<fs::path, std::size_t> files;
  for (const fs::path& file : files_below(kSource / "src/ident", {".h", ".cc"})) ++files[file.parent_path()];
  for (const auto& [folder, count] : files) EXPECT_LE(count, kMostFiles) << folder;
}

// Names of the free functions that a header declares at the left margin.
std::vector<std::string> declared_in(const std::string& header) {
  static const std::regex comment("//[^\n]*"),
      keyword("^(template|using|struct|class|enum|inline|constexpr|extern|namespace|static|#)");
  const std::string text = std::regex_replace(header, comment, "");
  std::vector<std::string> names;
  static const std::regex declaration(R"(\n([A-Za-z\[][^;{}()]*?\b([a-z_0-9]+)\()([^;{}]|\{\})*\)\s*;)");
  for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at)
    if (!std::regex_search((*at)[1].str(), keyword)) names.push_back((*at)[2]);
  return names;
}

// One source per instruction set, a source that the build writes, and one class whose parts are still to be
// taken apart.
bool is_defined_elsewhere(const fs::path& header) {
  const std::string name = fs::relative(header, kSource / "src/ident").generic_string();
  return name == "core/simd/dense_rows.h" || name == "flight/kernel/kernel.h" ||
         name == "flight/smoother/smoother.h" || name == "io/log/profile_texts.h";
}

TEST(Layering, WhatAHeaderDeclaresIsDefinedInTheSourceBesideIt) {
  for (const fs::path& header : files_below(kSource / "src/ident", {".h"})) {
    if (is_defined_elsewhere(header)) continue;
    const std::string source = "\n" + content(fs::path(header).replace_extension(".cc"));
    for (const std::string& name : declared_in(content(header)))
      EXPECT_TRUE(std::regex_search(source, std::regex("\\n[A-Za-z\\[][^;\n]*\\b" + name + "\\(")))
          << header << " declares " << name;
  }
}

// A build that compiles a whole folder as one source does not notice a missing include.
TEST(Layering, ASourceIncludesTheHeaderBesideIt) {
  for (const fs::path& header : files_below(kSource / "src/ident", {".h"})) {
    const fs::path source = fs::path(header).replace_extension(".cc");
    if (!fs::exists(source)) continue;
    const std::string name = fs::relative(header, kSource / "src").generic_string();
    EXPECT_NE(content(source).find("#include \"" + name + "\""), std::string::npos) << source;
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
    if (file.stem() != "effect" && file.stem() != "catalogue" && file.stem() != "all_parameters" &&
        file.stem() != "typical_scale" && file.stem() != "cause_traits")
      written.insert(file.stem().string());
  EXPECT_EQ(listed, written);
}

TEST(Layering, EveryAutopilotIsOneFileAndOneLine) {
  std::set<std::string> listed, written;
  for (const std::string& name :
       matches(content(kSource / "src/ident/fly/autopilots.def"), R"(\nIDENT_AUTOPILOT\((\w+)\))"))
    listed.insert(name);
  for (const fs::path& file : files_below(kSource / "src/ident/fly", {".cc"}))
    for (const std::string& name : matches(content(file), R"(\nAutopilotInfo (\w+)_autopilot\()")) {
      written.insert(name);
      EXPECT_EQ(file.stem().string(), name);
    }
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
