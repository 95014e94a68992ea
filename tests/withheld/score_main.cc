// withheld_score: compares answers with the truth of a campaign and prints the tables.
#include <iostream>
#include <stdexcept>

#include "score_tables.h"

namespace {

constexpr const char* kUsage =
    "withheld_score DIR [--answers FOLDER]... [--half odd|even|all] [--summary yes]\n"
    "  FOLDER below DIR, default answers; several are set side by side\n";

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::invalid_argument("DIR is needed");
    std::string half = "all";
    std::vector<std::string> folders;
    bool details = true;
    for (int i = 2; i < argc; i += 2) {
      const std::string name = argv[i];
      if (i + 1 >= argc) throw std::invalid_argument(name + " needs a value");
      if (name == "--answers")
        folders.emplace_back(argv[i + 1]);
      else if (name == "--half")
        half = argv[i + 1];
      else if (name == "--summary")
        details = std::string(argv[i + 1]) != "yes";
      else
        throw std::invalid_argument("no option is called " + name);
    }
    if (folders.empty()) folders = {"answers"};
    std::vector<withheld::Contestant> contestants;
    for (const std::string& folder : folders) {
      contestants.push_back({folder, withheld::read_campaign(argv[1], folder, half)});
    }
    withheld::print_summary(contestants, std::cout);
    for (const withheld::Contestant& contestant : contestants) {
      if (!details) break;
      std::cout << "\n## " << contestant.label << '\n';
      withheld::print_by_size(contestant, std::cout);
      withheld::print_confusion(contestant, std::cout);
      withheld::print_substitutes(contestant, std::cout);
      withheld::print_reliability(contestant, std::cout);
      withheld::print_limits(contestant, std::cout);
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::cerr << "withheld_score: " << error.what() << '\n' << kUsage;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "withheld_score: " << error.what() << '\n';
    return 1;
  }
}
