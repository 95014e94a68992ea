// Reads the files of a case.
#include "case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace field {
namespace {

namespace fs = std::filesystem;

json read_json(const std::string& path) {
  std::ifstream in(path);
  if (!in || in.peek() == std::ifstream::traits_type::eof()) return nullptr;
  return json::parse(in, nullptr, false);
}

Answer read_answer(const std::string& stem) {
  Answer answer;
  std::ifstream(stem + ".exit") >> answer.exit;
  double user = 0, system = 0;
  std::ifstream(stem + ".seconds") >> answer.wall >> user >> system;
  answer.processor = user + system;
  if (answer.exit == 0) answer.result = read_json(stem + ".json");
  return answer;
}

}  // namespace

std::string ScoredCase::file(const std::string& folder, const std::string& rest) const {
  return campaign + "/" + folder + "/" + name + rest;
}

bool ScoredCase::has_refined_file() const { return fs::exists(file(answers, ".refined.yaml")); }

std::vector<ScoredCase> read_cases(const std::string& campaign, const std::string& answers) {
  std::vector<ScoredCase> cases;
  for (const auto& entry : fs::directory_iterator(campaign + "/truth")) {
    ScoredCase c{.campaign = campaign, .answers = answers, .name = entry.path().stem().string()};
    c.truth = read_json(entry.path().string());
    c.refine = read_answer(c.file(answers, ".refine"));
    c.gap = read_answer(c.file(answers, ".gap"));
    if (c.refine.exit >= 0 || c.gap.exit >= 0) cases.push_back(std::move(c));
  }
  std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return cases;
}

std::string share(long count, long of) {
  char text[64];
  const double percent = of > 0 ? 100.0 * static_cast<double>(count) / static_cast<double>(of) : 0;
  std::snprintf(text, sizeof text, "%3ld/%-3ld (%3.0f %%)", count, of, percent);
  return text;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<size_t>(at);
  const size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace field
