// Outcomes of single cases, and the simple statistics over them.
#include "tally.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace withheld {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::group:
      return "in group";
    case Outcome::part:
      return "in part";
    case Outcome::extra:
      return "with extra";
    case Outcome::wide:
      return "wide group";
    case Outcome::wrong:
      return "wrong name";
    case Outcome::unknown:
      return "unknown";
    case Outcome::none:
      return "none";
    case Outcome::failed:
      return "no answer";
  }
  return "";
}

namespace {

bool contains_all(const Names& whole, const Names& part) {
  return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

bool estimated_well(const std::string& name, double truth, const Estimate& estimate, bool sign_is_free) {
  if (name.ends_with(".rotor")) return std::lround(estimate.value) == std::lround(truth);
  const double error = std::abs(estimate.value - truth);
  const double mirrored = sign_is_free ? std::abs(estimate.value + truth) : error;
  return std::min(error, mirrored) <= 2 * estimate.std;
}

}  // namespace

Outcome outcome_without_truth(const Answer& answer) {
  if (!answer.given) return Outcome::failed;
  if (answer.status == "none") return Outcome::none;
  if (answer.status == "unknown") return Outcome::unknown;
  return answer.names_causes() ? Outcome::wrong : Outcome::wide;
}

Outcome outcome_of(const Truth& truth, const Answer& answer) {
  const Names names = truth.names();
  if (names.empty() || !answer.given || answer.status == "none" || answer.status == "unknown") {
    return outcome_without_truth(answer);
  }
  Names allowed = names, named = answer.effects;
  allowed.insert(truth.accompanying.begin(), truth.accompanying.end());
  if (answer.status == "ambiguous") {
    named.insert(answer.confused_with.begin(), answer.confused_with.end());
    Names counted;
    for (const std::string& name : named) {
      if (truth.accompanying.count(name) == 0) counted.insert(name);
    }
    return contains_all(named, names) && counted.size() <= 3 ? Outcome::group : Outcome::wide;
  }
  if (contains_all(named, names)) return contains_all(allowed, named) ? Outcome::right : Outcome::extra;
  const bool some =
      std::any_of(names.begin(), names.end(), [&](const std::string& n) { return named.count(n) > 0; });
  return some && contains_all(allowed, named) ? Outcome::part : Outcome::wrong;
}

double size_of(const Truth& truth) {
  if (truth.outside) return truth.outside->over_limit;
  double size = truth.effects.empty() ? 0 : 1e9;
  for (const TrueEffect& effect : truth.effects) size = std::min(size, effect.over_limit);
  return size;
}

std::string SizeBin::label() const {
  char text[32];
  if (to > 1e6)
    std::snprintf(text, sizeof text, "over %g", from);
  else
    std::snprintf(text, sizeof text, "%g to %g", from, to);
  return text;
}

const std::vector<SizeBin>& size_bins() {
  static const std::vector<SizeBin> bins = {{0, 1}, {1, 2}, {2, 3}, {3, 5}, {5, 10}, {10, 30}, {30, 1e9}};
  return bins;
}

std::string Share::text() const {
  if (of == 0) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%.0f %% (%d/%d)", 100.0 * hits / of, hits, of);
  return text;
}

std::vector<Reliability> reliability(const std::vector<Scored>& cases) {
  std::vector<Reliability> deciles(10);
  for (const Scored& c : cases) {
    Names there = c.truth.names();
    there.insert(c.truth.accompanying.begin(), c.truth.accompanying.end());
    Names too_small;
    for (const TrueEffect& effect : c.truth.effects) {
      if (effect.over_limit < 1) too_small.insert(effect.name);
    }
    for (const auto& [name, candidate] : c.answer.candidates) {
      if (!candidate.probability || too_small.count(name) > 0) continue;
      const double p = std::clamp(*candidate.probability, 0.0, 1.0);
      Reliability& decile = deciles[static_cast<std::size_t>(std::min(9.0, 10 * p))];
      ++decile.count;
      decile.truly += there.count(name) > 0;
      decile.stated += p;
    }
  }
  return deciles;
}

Share recovery(const std::vector<Scored>& cases, const std::string& form) {
  Share share;
  for (const Scored& c : cases) {
    for (const TrueEffect& effect : c.truth.effects) {
      const auto found = c.answer.candidates.find(effect.name);
      const bool named = c.answer.names_causes() && c.answer.effects.count(effect.name) > 0;
      if (!named || effect.form != form || found == c.answer.candidates.end()) continue;
      for (const auto& [name, value] : effect.parameters) {
        const auto estimate = found->second.parameters.find(name);
        if (estimate == found->second.parameters.end()) continue;
        share.count(estimated_well(name, value, estimate->second, effect.name == "imu_misalignment"));
      }
    }
  }
  return share;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace withheld
