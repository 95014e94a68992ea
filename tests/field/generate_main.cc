// field_generate: draws vehicles, flies them and writes a campaign.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include "field_case.h"

namespace {

const char* const kUsage =
    "field_generate --seed S --cases N --out DIR [--first I] [--only plain|full|NAME[,NAME...]]\n";

std::map<std::string, std::string> read_options(int argc, char** argv) {
  std::map<std::string, std::string> options{{"--first", "0"}, {"--only", ""}};
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  if (argc % 2 == 0) throw std::invalid_argument("an option has no value");
  for (const char* needed : {"--seed", "--cases", "--out"}) {
    if (!options.contains(needed)) throw std::invalid_argument(std::string(needed) + " is missing");
  }
  if (options.size() != 5) throw std::invalid_argument("an option is not known");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto options = read_options(argc, argv);
    const auto seed = std::stoull(options.at("--seed"));
    const auto first = std::stoull(options.at("--first")), cases = std::stoull(options.at("--cases"));
    for (auto i = first; i < first + cases; ++i) {
      field::Case c = field::draw_case(seed, i, options.at("--only"));
      field::fly_case(c);
      field::write_case(c, options.at("--out"));
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n%s", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
