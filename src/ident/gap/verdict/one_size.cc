// Holds what the parts of a flight, and its channels, say of a cause against each other.
#include "ident/gap/verdict/one_size.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "ident/effects/catalogue.h"

namespace ident {
namespace {

// Scatter of a value over parts of the flight, in units of the usual one, that a constant does not have; and
// the share of itself by which it then changes. Motors are what they are only nearly.
constexpr double kChanges = 3.5;
constexpr double kChangesBy = 0.1;
constexpr double kMotorChangesBy = 0.5;
// What channels may ask of a cause's size: sum of the squares, in deviations, and by what share of itself one
// of them has to want it changed, by so many deviations. No true cause came near the first. Of flow, 110
// right names of which a channel asked for half as much again had a sum of 33 at most, wrong ones of 93 and
// more.
constexpr double kAtOdds = 40.0, kFlowAtOdds = 60.0;
constexpr double kAtOddsBy = 0.25, kFlowAtOddsBy = 0.5;
constexpr double kAsksFor = 3.5;

bool is_one_of(const Candidate& cause, std::initializer_list<const char*> names) {
  return std::ranges::find(names, cause.name) != names.end();
}

// What air does with height, or a drive, has its own form in each channel. Other flow has one but for its
// finer points: of a linear drag in the place of a quadratic one forces and moments want very different
// sizes.
struct Odds {
  double by, sum;
};
Odds odds_allowed(const Candidate& cause) {
  if (!is_loose(cause)) return {kAtOddsBy, kAtOdds};
  const EffectEntry* effect = find_effect(cause.name);
  const bool flow_alone =
      effect && (effect->info.touches & kTouchFlow) != 0 && (effect->info.touches & kTouchHeight) == 0;
  return {flow_alone ? kFlowAtOddsBy : std::numeric_limits<double>::infinity(), kFlowAtOdds};
}

}  // namespace

bool is_of_motors(const Candidate& cause) {
  return is_one_of(
      cause, {"motor_delay", "motor_asymmetry", "parameter:omega_m", "parameter:zeta_m", "parameter:km"});
}

bool is_of_drive(const std::string& cause) { return cause == "battery_sag" || cause == "thrust_curve"; }

bool is_loose(const Candidate& cause) {
  const EffectEntry* effect = find_effect(cause.name);
  return is_of_drive(cause.name) || (effect && (effect->info.touches & (kTouchFlow | kTouchHeight)) != 0);
}

const Candidate* changing(const SearchResult& search) {
  const double most = kChanges * std::max(search.usual_scatter(), 1.0);
  for (const Candidate& c : search.best.adopted) {
    const double by = is_of_motors(c) ? kMotorChangesBy : kChangesBy;
    if (!is_loose(c) && search.scatter_of(c) > most && search.change_of(c) > by) return &c;
  }
  return nullptr;
}

const Candidate* at_odds(const SearchResult& search, std::string& part) {
  for (std::size_t i = 0; i < search.asked.size(); ++i) {
    const Candidate& cause = search.best.adopted[i];
    const auto [by, sum] = odds_allowed(cause);
    double odds = 0, most = 0;
    for (const Asked& a : search.asked[i]) {
      if (a.weight < kHasASay) continue;
      const double asks = a.std > 0 ? std::abs(a.change) / a.std : 0.0;
      odds += asks * asks;
      if (std::abs(a.change) > by && asks > std::max(most, kAsksFor)) most = asks, part = a.part;
    }
    if (odds > sum && most > 0) return &cause;
  }
  return nullptr;
}

}  // namespace ident
