// field_score: what the answers to a campaign are worth.
#include <cstdio>
#include <exception>
#include <string>

#include "tables.h"

int main(int argc, char** argv) {
  std::string campaign, answers = "answers";
  bool details = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--details") {
      details = true;
    } else if (option == "--answers" && i + 1 < argc) {
      answers = argv[++i];
    } else if (campaign.empty() && !option.starts_with("--")) {
      campaign = option;
    } else {
      campaign.clear();
      break;
    }
  }
  if (campaign.empty()) {
    std::fprintf(stderr, "field_score DIR [--answers FOLDER] [--details]\n");
    return 2;
  }
  try {
    const auto cases = field::read_cases(campaign, answers);
    std::printf("%zu cases with answers\n", cases.size());
    field::print_prediction(cases, details);
    field::print_coverage(cases, details);
    field::print_diagnosis(cases, details);
    field::print_seconds(cases);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
