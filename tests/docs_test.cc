// The documents say what is there: links and paths lead to files, and every subcommand is explained.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = IDENT_SOURCE_DIR;
const fs::path kGuide = kSource / "notebooks/guide";

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// The pages of a user: README and the guide.
std::vector<fs::path> pages() {
  std::vector<fs::path> list{kSource / "README.md"};
  for (const auto& entry : fs::directory_iterator(kGuide))
    if (entry.path().extension() == ".md") list.push_back(entry.path());
  return list;
}

/// The theory beside the code: README.md of the folders of src/ident.
std::vector<fs::path> theory() {
  std::vector<fs::path> list;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "src/ident"))
    if (entry.path().filename() == "README.md") list.push_back(entry.path());
  return list;
}

/// The anchor that a heading gets: lower case, blanks as hyphens, nothing else but letters and digits.
std::string anchor(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
      out += static_cast<char>(std::tolower(byte));
    if (c == ' ') out += '-';
  }
  return out;
}

bool has_heading(const fs::path& page, const std::string& wanted) {
  std::ifstream in(page);
  bool code = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) code = !code;
    const std::size_t text = line.find_first_not_of('#');
    if (code || text == 0 || text == std::string::npos) continue;
    if (anchor(line.substr(text + 1)) == wanted) return true;
  }
  return false;
}

TEST(Documents, ReadmeIsShort) {
  const std::string readme = content(kSource / "README.md");
  EXPECT_LE(std::ranges::count(readme, '\n'), 200);
}

TEST(Documents, LinksLeadToFilesAndHeadings) {
  for (std::vector<fs::path> all = pages(); const fs::path& page : all)
    for (const std::string& link : matches(content(page), R"(\]\(([^)\s]+)\))")) {
      if (link.starts_with("http")) continue;
      const std::size_t hash = link.find('#');
      const std::string file = link.substr(0, hash);
      const fs::path target = file.empty() ? page : page.parent_path() / file;
      ASSERT_TRUE(fs::exists(target)) << page << " links to " << link;
      if (hash == std::string::npos) continue;
      EXPECT_TRUE(has_heading(target, link.substr(hash + 1))) << page << " links to " << link;
    }
}

TEST(Documents, EverySubcommandIsInTheGuide) {
  const std::string guide = content(kGuide / "user_guide.md") + content(kGuide / "formats.md");
  const std::vector<std::string> commands =
      matches(content(kSource / "apps/commands.def"), R"(\nIDENT_COMMAND\((\w+),)");
  ASSERT_FALSE(commands.empty());
  for (const std::string& name : commands)
    EXPECT_NE(guide.find("ident " + name), std::string::npos) << name << " is explained nowhere";
}

TEST(Documents, FilesThatTheTheoryNamesAreThere) {
  for (const fs::path& page : theory())
    for (const std::string& name : matches(content(page), R"(`([\w./]+\.(?:h|cc|def|md|py|sh))`)")) {
      const bool there = fs::exists(page.parent_path() / name) || fs::exists(kSource / "src/ident" / name) ||
                         fs::exists(kSource / name);
      EXPECT_TRUE(there) << page << " names " << name;
    }
}

}  // namespace
}  // namespace ident
