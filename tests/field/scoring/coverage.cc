// Do the 95 % intervals of constants that are called known hold the truth?
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "tables.h"

namespace field {
namespace {

struct Interval {
  double value = 0, low = 0, high = 0;
};

struct Count {
  long known = 0, held = 0, near = 0;
  std::vector<double> errors;  // beyond the true range, relative
};

constexpr double kNear = 0.02;  // of the truth: an interval that misses by less does no harm

double correlation(const json& result, const std::string& a, const std::string& b) {
  if (!result.contains("correlation") || !result["correlation"].contains("names")) return 0;
  const json& names = result["correlation"]["names"];
  int i = -1, j = -1;
  for (int k = 0; k < static_cast<int>(names.size()); ++k) {
    if (names[static_cast<size_t>(k)] == a) i = k;
    if (names[static_cast<size_t>(k)] == b) j = k;
  }
  if (i < 0 || j < 0) return 0;
  const json& entry = result["correlation"]["matrix"][static_cast<size_t>(i)][static_cast<size_t>(j)];
  return entry.is_number() ? entry.get<double>() : 0;
}

std::optional<Interval> interval(const json& parameter) {
  if (!parameter["ci95"].is_array() || !parameter["ci95"][0].is_number()) return std::nullopt;
  return Interval{parameter["value"], parameter["ci95"][0], parameter["ci95"][1]};
}

bool called_known(const json& parameter) {
  return parameter.contains("identifiable") && parameter["identifiable"].is_boolean() &&
         parameter["identifiable"].get<bool>();
}

// lag = 2 zeta_m/omega_m, with the correlation of both.
std::optional<Interval> lag(const json& result) {
  const json& p = result["parameters"];
  if (!p.contains("omega_m") || !p.contains("zeta_m") || !called_known(p["omega_m"])) return std::nullopt;
  const double w = p["omega_m"]["value"], z = p["zeta_m"]["value"];
  const double a = p["omega_m"].value("std", 0.0) / w, b = p["zeta_m"].value("std", 0.0) / z;
  const double variance = a * a + b * b - 2 * correlation(result, "omega_m", "zeta_m") * a * b;
  const double value = 2 * z / w, reach = 1.96 * std::sqrt(std::max(0.0, variance));
  return Interval{value, value * std::exp(-reach), value * std::exp(reach)};
}

std::map<std::string, Interval> known_intervals(const json& result) {
  std::map<std::string, Interval> known;
  for (const auto& [name, parameter] : result["parameters"].items()) {
    if (name == "omega_m" || name == "zeta_m" || !called_known(parameter)) continue;
    if (const auto i = interval(parameter)) known[name] = *i;
  }
  if (const auto i = lag(result)) known["lag"] = *i;
  return known;
}

struct Miss {
  bool held = true;
  double beyond = 0;  // from the estimate to the true range, relative
};

Miss compare(const Interval& i, const json& range) {
  const double low = range[0], high = range[1];
  const double size = std::max(std::abs(low), std::abs(high));
  const double off = i.value < low ? i.value - low : i.value > high ? i.value - high : 0;
  return {i.high >= low && i.low <= high, size > 0 ? off / size : off == 0 ? 0 : std::copysign(1.0, off)};
}

void print_row(const std::string& name, const Count& c) {
  std::printf("%-24s %s %s  %+6.1f %+6.1f %+6.1f %%\n", name.c_str(), share(c.held, c.known).c_str(),
              share(c.near, c.known).c_str(), 100 * quantile(c.errors, 0.1), 100 * quantile(c.errors, 0.5),
              100 * quantile(c.errors, 0.9));
}

}  // namespace

void print_coverage(const std::vector<ScoredCase>& cases, bool details) {
  std::printf("\nIntervals of what is called known against the truth\n");
  std::printf("%-24s %-15s %-15s  %s\n", "", "95 % hold", "or within 2 %", "error at 10, 50, 90 %");
  std::map<std::string, Count> counts;
  Count all, plain, full;
  std::string misses;
  for (const ScoredCase& c : cases) {
    if (!c.refine.result.is_object()) continue;
    for (const auto& [name, i] : known_intervals(c.refine.result)) {
      if (!c.truth["true_ranges"].contains(name)) continue;
      const Miss miss = compare(i, c.truth["true_ranges"][name]);
      for (Count* count : {&counts[name], &all, c.plain() ? &plain : &full}) {
        ++count->known;
        count->held += miss.held;
        count->near += miss.held || std::abs(miss.beyond) < kNear;
        count->errors.push_back(miss.beyond);
      }
      if (miss.held) continue;
      char text[160];
      std::snprintf(text, sizeof text, "  %s %-20s [%.4g, %.4g] truth [%.4g, %.4g], %+.1f %%\n",
                    c.name.c_str(), name.c_str(), i.low, i.high,
                    c.truth["true_ranges"][name][0].get<double>(),
                    c.truth["true_ranges"][name][1].get<double>(), 100 * miss.beyond);
      misses += text;
    }
  }
  for (const auto& [name, count] : counts) print_row(name, count);
  print_row("all", all);
  print_row("nothing beside constants", plain);
  print_row("with effects", full);
  if (details && !misses.empty()) std::printf("intervals that do not hold:\n%s", misses.c_str());
}

}  // namespace field
