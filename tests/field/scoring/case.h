// One case of a campaign with its truth and its answers, as the scorer reads them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace field {

using nlohmann::json;

struct Answer {
  json result;                     // null where there is none
  int exit = -1;                   // 124: out of time
  double wall = 0, processor = 0;  // s
};

struct ScoredCase {
  std::string campaign, answers, name;
  json truth;
  Answer refine, gap;
  bool plain() const { return truth["plain"].get<bool>(); }
  bool has_refined_file() const;
  std::string file(const std::string& folder, const std::string& rest) const;
};

// Cases that have any answer, in order.
std::vector<ScoredCase> read_cases(const std::string& campaign, const std::string& answers);

// "12/40 (30 %)".
std::string share(long count, long of);
double quantile(std::vector<double> values, double q);

}  // namespace field
