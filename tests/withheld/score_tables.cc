// The detailed tables: by size, by effect, substitutes, reliability, detection limits.
#include "score_tables.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>

#include "tally.h"

namespace withheld {

namespace {

constexpr Outcome kOutcomes[] = {Outcome::right,   Outcome::group, Outcome::part,
                                 Outcome::extra,   Outcome::wide,  Outcome::wrong,
                                 Outcome::unknown, Outcome::none,  Outcome::failed};

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text;
}

std::string said(const Answer& answer) {
  if (!answer.given) return "no answer";
  if (answer.status == "none" || answer.status == "unknown") return answer.status;
  if (answer.status == "identified") return joined(answer.effects);
  if (answer.status == "partly") return joined(answer.effects) + " and more";
  Names all = answer.effects;
  all.insert(answer.confused_with.begin(), answer.confused_with.end());
  return "ambiguous";
}

// "unknown 12, cg_offset 3": the most frequent first.
std::string counted(const std::map<std::string, int>& counts) {
  std::vector<std::pair<std::string, int>> order(counts.begin(), counts.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, count] : order)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}

void size_table(const std::string& title, const std::vector<std::pair<double, Outcome>>& results,
                std::ostream& out) {
  if (results.empty()) return;
  out << "\n**" << title << "**\n\n| size over limit | cases |";
  for (const Outcome o : kOutcomes) out << ' ' << name_of(o) << " |";
  out << "\n|---|---|";
  for (std::size_t i = 0; i < std::size(kOutcomes); ++i) out << "---|";
  out << '\n';
  for (const SizeBin& bin : size_bins()) {
    std::map<Outcome, int> counts;
    int all = 0;
    for (const auto& [size, outcome] : results) {
      if (size < bin.from || size >= bin.to) continue;
      ++counts[outcome];
      ++all;
    }
    out << "| " << bin.label() << " | " << all << " |";
    for (const Outcome o : kOutcomes) out << ' ' << counts[o] << " |";
    out << '\n';
  }
}

}  // namespace

void print_by_size(const Contestant& contestant, std::ostream& out) {
  std::map<std::string, std::vector<std::pair<double, Outcome>>> tables;
  std::vector<std::pair<double, Outcome>> excluded;
  for (const Scored& c : contestant.cases) {
    if (c.truth.kind != "none")
      tables[c.truth.kind].emplace_back(size_of(c.truth), outcome_of(c.truth, c.answer));
    if (c.excluded) excluded.emplace_back(size_of(c.truth), outcome_without_truth(*c.excluded));
  }
  size_table("Single effects", tables["single"], out);
  size_table("Pairs, by the smaller member", tables["pair"], out);
  size_table("From outside the catalogue", tables["outside"], out);
  size_table("Truth taken out of the catalogue", excluded, out);
}

void print_confusion(const Contestant& contestant, std::ostream& out) {
  std::map<std::string, std::map<std::string, int>> rows;
  std::map<std::string, Share> right;
  for (const Scored& c : contestant.cases) {
    if (c.truth.kind != "single" && c.truth.kind != "none") continue;
    if (c.truth.kind == "single" && size_of(c.truth) < 1) continue;
    const std::string truth = c.truth.kind == "none" ? "(none)" : joined(c.truth.names());
    const Outcome outcome = outcome_of(c.truth, c.answer);
    right[truth].count(outcome == Outcome::right || (c.truth.kind == "none" && outcome == Outcome::none));
    std::string answer = said(c.answer);
    if (outcome == Outcome::group) answer = "group with it";
    if (outcome == Outcome::right) answer = "**right**";
    ++rows[truth][answer];
  }
  out << "\n**Confusion, single effects of 1 x limit or more**\n\n| truth | right | answers "
         "|\n|---|---|---|\n";
  for (const auto& [truth, answers] : rows) {
    out << "| " << truth << " | " << right[truth].text() << " | " << counted(answers) << " |\n";
  }
  std::map<std::string, std::map<std::string, int>> pairs;
  for (const Scored& c : contestant.cases) {
    if (c.truth.kind != "pair" || size_of(c.truth) < 3) continue;
    const Outcome outcome = outcome_of(c.truth, c.answer);
    if (outcome != Outcome::right)
      ++pairs[joined(c.truth.names())][std::string(name_of(outcome)) + ": " + said(c.answer)];
  }
  if (pairs.empty()) return;
  out << "\n**Pairs of 3 x limit or more that were missed**\n\n| truth | answers |\n|---|---|\n";
  for (const auto& [truth, answers] : pairs) out << "| " << truth << " | " << counted(answers) << " |\n";
}

void print_substitutes(const Contestant& contestant, std::ostream& out) {
  std::map<std::string, std::map<std::string, int>> rows;
  for (const Scored& c : contestant.cases) {
    if (size_of(c.truth) < 5) continue;
    if (c.truth.outside)
      ++rows["outside: " + c.truth.outside->name][said(c.answer)];
    else if (c.excluded && c.truth.kind == "single")
      ++rows["without " + joined(c.truth.names())][said(*c.excluded)];
  }
  out << "\n**What is said where only `unknown` is right, 5 x limit or more**\n\n| truth | answers "
         "|\n|---|---|\n";
  for (const auto& [truth, answers] : rows) out << "| " << truth << " | " << counted(answers) << " |\n";
}

void print_reliability(const Contestant& contestant, std::ostream& out) {
  out << "\n**Reliability of the probabilities**\n\n| decile | candidates | stated | true "
         "|\n|---|---|---|---|\n";
  const auto deciles = reliability(contestant.cases);
  for (std::size_t i = 0; i < deciles.size(); ++i) {
    const Reliability& d = deciles[i];
    char text[96];
    const double count = std::max(1, d.count);
    std::snprintf(text, sizeof text, "| %.1f to %.1f | %d | %.3f | %.3f |\n", 0.1 * static_cast<double>(i),
                  0.1 * static_cast<double>(i + 1), d.count, d.stated / count, d.truly / count);
    if (d.count > 0) out << text;
  }
}

void print_limits(const Contestant& contestant, std::ostream& out) {
  std::map<std::string, std::vector<double>> ratios;
  for (const Scored& c : contestant.cases) {
    if (c.truth.kind != "single" || c.truth.effects[0].parameters.size() != 1) continue;
    const TrueEffect& effect = c.truth.effects[0];
    const auto& [name, value] = *effect.parameters.begin();
    const auto found = c.answer.candidates.find(effect.name);
    if (found == c.answer.candidates.end() || name.find('.') == std::string::npos) continue;
    const auto limit = found->second.detection_limit.find(name);
    const double null = name.ends_with(".ratio") ? 1 : 0;
    if (limit == found->second.detection_limit.end() || effect.over_limit <= 0) continue;
    ratios[name].push_back(limit->second / (std::abs(value - null) / effect.over_limit));
  }
  if (ratios.empty()) return;
  out << "\n**Detection limit as the tool states it over the generator's, median**\n\n| parameter | ratio | "
         "cases |\n|---|---|---|\n";
  for (const auto& [name, values] : ratios) {
    out << "| " << name << " | " << std::setprecision(3) << median(values) << " | " << values.size()
        << " |\n";
  }
}

}  // namespace withheld
