// The notebooks are kept as they ran: every cell executed, none failed, no path of the machine in what they
// show.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(IDENT_SOURCE_DIR) / "notebooks";

std::vector<fs::path> notebooks() {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".ipynb") found.push_back(entry.path());
  return found;
}

nlohmann::json code_cells(const fs::path& path) {
  nlohmann::json cells = nlohmann::json::array();
  const nlohmann::json notebook = nlohmann::json::parse(std::ifstream(path));
  for (const nlohmann::json& cell : notebook.at("cells"))
    if (cell.at("cell_type") == "code") cells.push_back(cell);
  return cells;
}

TEST(Notebooks, AreKeptWithTheOutputOfEveryCell) {
  const std::vector<fs::path> all = notebooks();
  ASSERT_FALSE(all.empty());
  for (const fs::path& path : all) {
    int expected = 0, pictures = 0;
    for (const nlohmann::json& cell : code_cells(path)) {
      EXPECT_EQ(cell.at("execution_count"), ++expected) << path << ": run tests/notebooks/run.sh --update";
      for (const nlohmann::json& output : cell.at("outputs")) {
        EXPECT_NE(output.at("output_type"), "error") << path;
        EXPECT_NE(output.value("name", ""), "stderr") << path << output;
        if (output.contains("data")) pictures += output.at("data").contains("image/png");
      }
    }
    EXPECT_GT(pictures, 0) << path << " shows nothing";
  }
}

TEST(Notebooks, ShowNoPathOfTheMachineThatRanThem) {
  for (const fs::path& path : notebooks())
    for (const nlohmann::json& cell : code_cells(path))
      for (const nlohmann::json& output : cell.at("outputs"))
        for (const char* part : {"/tmp/", "/home/", "/root/", IDENT_SOURCE_DIR})
          EXPECT_EQ(output.dump().find(part), std::string::npos) << path << ": " << part;
}

TEST(Notebooks, AreNamedInTheirGuide) {
  std::ifstream file(kFolder / "README.md");
  const std::string guide{std::istreambuf_iterator<char>(file), {}};
  for (const fs::path& path : notebooks())
    EXPECT_NE(guide.find(path.filename().string()), std::string::npos) << path.filename();
}

}  // namespace
}  // namespace ident
