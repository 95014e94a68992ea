// What the diagnosis names, against what is there.
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "tables.h"

namespace field {
namespace {

using Names = std::set<std::string>;
constexpr double kMaterial = 0.1;  // share of the gap from which a cause is asked for

Names names(const json& list) {
  Names out;
  for (const auto& name : list) out.insert(name.get<std::string>());
  return out;
}

// Share of the gap that a cause closes in the generator's own account, in the log and group where it closes
// most.
std::map<std::string, double> shares_of(const ScoredCase& c) {
  std::map<std::string, double> shares;
  for (const auto& [cause, logs] : c.truth["shares"].items()) {
    double most = 0;
    for (const auto& log : logs) {
      for (const char* group : {"all", "forces", "moments"}) most = std::max(most, log[group].get<double>());
    }
    shares[cause == "parameter:lag" ? "parameter:omega_m" : cause] = most;
  }
  return shares;
}

struct Verdict {
  std::string status;
  Names named, confused, right, wrong;
};

Verdict judge(const ScoredCase& c) {
  const json& verdict = c.gap.result["verdict"];
  Verdict v{.status = verdict["status"], .named = names(verdict["effects"])};
  if (verdict.contains("confused_with")) v.confused = names(verdict["confused_with"]);
  Names truth = names(c.truth["present"]);
  truth.merge(names(c.truth["implied"]));
  for (const auto& name : v.named) (truth.contains(name) ? v.right : v.wrong).insert(name);
  // Of an ambiguous verdict one name that is right is enough.
  const bool group_right =
      std::any_of(v.confused.begin(), v.confused.end(), [&](const auto& n) { return truth.contains(n); });
  if (v.status == "ambiguous" && (!v.right.empty() || group_right)) v.wrong.clear();
  return v;
}

struct CauseCount {
  long there = 0, named = 0, grouped = 0, unasked_named = 0;
};

struct Tally {
  long cases = 0, failed = 0, any_right = 0, any_wrong = 0, confident_wrong = 0;
  std::map<std::string, long> status;

  void add(const ScoredCase& c, const Verdict& v) {
    (void)c;
    ++cases;
    ++status[v.status];
    any_right += !v.right.empty();
    any_wrong += !v.wrong.empty();
    confident_wrong += !v.wrong.empty() && v.right.empty();
  }
  void print(const char* title) const {
    std::printf("%-26s %3ld  ", title, cases);
    for (const char* s : {"none", "identified", "partly", "ambiguous", "unknown"}) {
      std::printf(" %s %ld", s, status.contains(s) ? status.at(s) : 0);
    }
    std::printf("\n%-26s      a right name %s, a wrong name %s, wrong names alone %s\n", "",
                share(any_right, cases).c_str(), share(any_wrong, cases).c_str(),
                share(confident_wrong, cases).c_str());
  }
};

std::string joined(const Names& list) {
  std::string text;
  for (const auto& name : list) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "-" : text;
}

void count_causes(const ScoredCase& c, const Verdict& v, std::map<std::string, CauseCount>& causes) {
  const Names present = names(c.truth["present"]);
  for (const auto& [cause, share] : shares_of(c)) {
    if (!present.contains(cause)) continue;
    CauseCount& count = causes[cause];
    if (share >= kMaterial) {
      ++count.there;
      count.named += v.named.contains(cause);
      count.grouped += !v.named.contains(cause) && v.confused.contains(cause);
    } else {
      count.unasked_named += v.named.contains(cause);
    }
  }
}

void print_case(const ScoredCase& c, const Verdict& v) {
  Names material;
  for (const auto& [cause, share] : shares_of(c)) {
    const bool there = names(c.truth["present"]).contains(cause) || names(c.truth["outside"]).contains(cause);
    char text[80];
    std::snprintf(text, sizeof text, "%s %.2f", cause.c_str(), share);
    if (there && share >= kMaterial) material.insert(text);
  }
  std::printf("  %s %-5s %-10s right: %s; wrong: %s; with: %s\n       there: %s; outside: %s\n",
              c.name.c_str(), c.plain() ? "plain" : "full", v.status.c_str(), joined(v.right).c_str(),
              joined(v.wrong).c_str(), joined(v.confused).c_str(), joined(material).c_str(),
              joined(names(c.truth["outside"])).c_str());
}

}  // namespace

void print_diagnosis(const std::vector<ScoredCase>& cases, bool details) {
  std::printf("\nDiagnosis\n");
  Tally plain, full;
  long failed = 0;
  std::map<std::string, CauseCount> causes;
  std::map<std::string, long> wrong;
  for (const ScoredCase& c : cases) {
    if (c.gap.exit < 0) continue;
    if (!c.gap.result.is_object()) {
      ++failed;
      std::printf("  %s no answer, exit %d\n", c.name.c_str(), c.gap.exit);
      continue;
    }
    const Verdict v = judge(c);
    (c.plain() ? plain : full).add(c, v);
    count_causes(c, v, causes);
    for (const auto& name : v.wrong) ++wrong[name];
    if (details) print_case(c, v);
  }
  plain.print("nothing beside constants");
  full.print("with effects");
  if (failed > 0) std::printf("no answer: %ld\n", failed);
  std::printf("\n%-26s %-15s %-15s %s\n", "there, 10 % of the gap", "named", "in the group",
              "named, though smaller");
  for (const auto& [name, c] : causes) {
    if (c.there + c.unasked_named == 0) continue;
    std::printf("%-26s %s %s %ld\n", name.c_str(), share(c.named, c.there).c_str(),
                share(c.grouped, c.there).c_str(), c.unasked_named);
  }
  if (wrong.empty()) return;
  std::printf("wrong names:");
  for (const auto& [name, count] : wrong) std::printf(" %s %ld", name.c_str(), count);
  std::printf("\n");
}

void print_seconds(const std::vector<ScoredCase>& cases) {
  std::printf("\n%-12s %-6s %-26s %s\n", "Seconds", "runs", "wall: median, 95 %, most",
              "processor: median, 95 %, most");
  for (const bool of_gap : {false, true}) {
    std::vector<double> wall, processor;
    for (const ScoredCase& c : cases) {
      const Answer& answer = of_gap ? c.gap : c.refine;
      if (answer.exit < 0) continue;
      wall.push_back(answer.wall);
      processor.push_back(answer.processor);
    }
    std::printf("%-12s %-6zu %6.1f %6.1f %6.1f       %6.1f %6.1f %6.1f\n", of_gap ? "gap" : "refine",
                wall.size(), quantile(wall, 0.5), quantile(wall, 0.95), quantile(wall, 1),
                quantile(processor, 0.5), quantile(processor, 0.95), quantile(processor, 1));
  }
}

}  // namespace field
