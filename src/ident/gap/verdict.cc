// The rules of a verdict.
#include "ident/gap/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "ident/core/format_number.h"
#include "ident/gap/further.h"

namespace ident {
namespace {

// A verdict needs this much of the explainable gap closed; below it most of the gap remains unexplained.
constexpr double kMostlyClosed = 0.5;
constexpr double kPerhapsClosed = 0.75;  // unless so much lies within the 95 % interval
// A generic rival that gains this much on held-out flight has seen something, and that share of what the
// causes explain is too much for a catalogue that should be enough.
constexpr double kRivalGain = 45.0;
constexpr double kRivalBeside = 60.0;  // beside causes, whose own form is never quite that of the real thing
constexpr double kRivalShare = 0.12;
constexpr double kSure = 0.9;
// Scatter of a value over parts of the flight, in units of the usual one, that a constant does not have.
constexpr double kChanges = 2.8;
// Standard deviations by which a constant may be pulled off its bench value beside the right cause.
constexpr double kContradicts = 5.0;
// And as many of the bench's own, which a flight that tells little need not reach.
constexpr double kOff = 2.0;

// The effect `wind` brings its drag along as a nuisance when the vehicle file has none.
std::vector<std::string> names_of(const std::vector<Candidate>& adopted) {
  std::vector<std::string> names;
  const bool wind = std::ranges::any_of(adopted, [](const Candidate& c) { return c.name == "wind"; });
  for (const Candidate& c : adopted) {
    if (wind && (c.name == "rotor_drag" || c.name == "parasitic_drag")) continue;
    if (std::ranges::find(names, c.name) == names.end()) names.push_back(c.name);
  }
  return names;
}

// Two causes that move masses are what one thing bolted on would do. With the payload in the catalogue it
// stands beside them there.
bool may_be_one_payload(const SearchResult& search) {
  const bool there =
      std::ranges::any_of(search.problem.candidates, [](const Candidate& c) { return c.name == "payload"; });
  return !there && std::ranges::count_if(search.best.adopted, moves_mass) >= 2;
}

// Whether the value of a cause is one of the vehicle as it stands, which no flight changes. What air, battery
// and motors do follows its equation only nearly.
bool stays_put(const Candidate& cause) {
  constexpr std::array nearly = {"battery_sag",       "motor_delay",      "thrust_curve",
                                 "parameter:omega_m", "parameter:zeta_m", "parameter:km"};
  if (std::ranges::find(nearly, cause.name) != nearly.end()) return false;
  const EffectEntry* effect = find_effect(cause.name);
  return !effect || (effect->info.touches & (kTouchFlow | kTouchHeight)) == 0;
}

// The cause found whose value changes from one part of the flight to the next though it should not: another
// one acts there in its place.
const Candidate* changing(const SearchResult& search) {
  const double most = kChanges * std::max(search.usual_scatter(), 1.0);
  for (const Candidate& c : search.best.adopted)
    if (stays_put(c) && search.scatter_of(c) > most) return &c;
  return nullptr;
}

// The constant that the flight, with the causes found, pulls furthest off its bench value, if too far. One
// whose value is among those causes may be anywhere.
const Parameter* contradicted(const std::vector<Parameter>& fitted, const std::vector<Candidate>& adopted) {
  const Parameter* worst = nullptr;
  double most = kContradicts;
  for (const Parameter& p : fitted) {
    const bool heard = p.from_flight && *p.from_flight > 0.05;
    const auto is_it = [&](const Candidate& c) {  // omega_m and zeta_m are one thing, the motors' lag
      const bool lag = p.name == "omega_m" || p.name == "zeta_m";
      return c.name == "parameter:" + p.name ||
             (lag && (c.name == "parameter:omega_m" || c.name == "parameter:zeta_m"));
    };
    const bool off = p.prior_value && std::abs(p.value - *p.prior_value) > kOff * p.prior_std.value_or(1e300);
    if (!p.pull || !heard || !off || !(std::abs(*p.pull) > most) || std::ranges::any_of(adopted, is_it))
      continue;
    worst = &p, most = std::abs(*p.pull);
  }
  return worst;
}

// What speaks against naming the causes found, as the end of a sentence; empty if nothing does.
std::string against_naming(const SearchResult& search, const GapClosed& gap, const Rival& rival,
                           const std::vector<Parameter>& fitted) {
  if (std::isfinite(gap.closed) && gap.closed < kMostlyClosed && !(gap.ci95[1] > kPerhapsClosed))
    return "most of the gap remains with it";
  if (rival.total() > std::max(kRivalBeside, kRivalShare * search.explained))
    return "a plain regression on the flight predicts what it leaves, most in " + rival.strongest();
  if (const Parameter* p = contradicted(fitted, search.best.adopted))
    return fmt::format(
        "with that the flight contradicts the value of {} known beforehand by {:.0f} standard deviations",
        p->name, std::abs(*p->pull));
  if (const Candidate* cause = changing(search))
    return fmt::format("the value of {} would have to change from one part of the flight to the next",
                       described(*cause));
  if (may_be_one_payload(search))
    return "all of that at once is what one thing bolted on would do, and a payload was not among the "
           "causes tried";
  return {};
}

}  // namespace

Judged judge(const SearchResult& search, const GapClosed& gap, const Rival& rival,
             const std::vector<SpectralLine>& lines, const std::vector<Burst>& jumps,
             const std::vector<Parameter>& fitted) {
  Judged out;
  out.effects = names_of(search.best.adopted);
  if (!search.ran_away.empty()) {
    out.status = "unknown";
    out.confused_with = search.ran_away;
    out.effects.clear();
    out.sentence =
        fmt::format("A gap is there that looks like {}, but no full model with that flies as these logs do.",
                    fmt::join(search.ran_away, " or "));
    return out;
  }
  if (out.effects.empty()) {
    if (rival.total() > kRivalGain) {
      out.status = "unknown";
      out.sentence =
          "Something acts on this vehicle that no single cause of the catalogue explains: what the model "
          "misses, most in " +
          rival.strongest() + ", can be predicted from the flight itself.";
    } else if (!lines.empty()) {
      out.status = "unknown";
      out.sentence = fmt::format(
          "Something swings or vibrates at {} Hz (seen in {}) that no cause of the catalogue explains: a "
          "slung or "
          "loose load, a flexible arm, a propeller out of balance.",
          format_number(lines[0].hz, 3), lines[0].channel);
    } else if (!jumps.empty()) {
      out.status = "unknown";
      out.sentence = fmt::format(
          "Something strikes this vehicle at moments (seen in {}, most at {} s of log {}): the wash of "
          "another "
          "vehicle, a touch, a part that comes loose. No cause of the catalogue does that.",
          jumps[0].channel, format_number(jumps[0].t, 3), jumps[0].log + 1);
    } else {
      out.status = "none";
      out.sentence = "The model explains these logs down to the noise; no cause stands out.";
    }
    return out;
  }
  if (std::isfinite(gap.closed)) out.remaining = std::max(0.0, 1 - gap.closed);
  if (const std::string why = against_naming(search, gap, rival, fitted); !why.empty()) {
    out.status = "unknown";
    out.sentence =
        fmt::format("A gap is there that the catalogue does not explain. The nearest is {}, but {}.",
                    fmt::join(out.effects, " with "), why);
    out.confused_with = std::exchange(out.effects, {});
    return out;
  }
  // Other sets that explain it about as well; one with a further cause beside those found is none.
  double own = 0;
  const std::set<std::string> named(out.effects.begin(), out.effects.end());
  for (const WeighedSet& set : search.sets) {
    std::set<std::string> names;
    std::vector<Candidate> members;
    for (const int m : set.members) members.push_back(search.problem.candidates[static_cast<std::size_t>(m)]);
    for (const std::string& n : names_of(members)) names.insert(n);
    if (std::ranges::includes(names, named)) {
      own += set.probability;
    } else if (set.probability > 0.05) {
      for (const std::string& n : names)
        if (std::ranges::find(out.effects, n) == out.effects.end() &&
            std::ranges::find(out.confused_with, n) == out.confused_with.end())
          out.confused_with.push_back(n);
    }
  }
  out.status = own < kSure && !out.confused_with.empty() ? "ambiguous" : "identified";
  if (out.status == "identified") out.confused_with.clear();
  out.sentence = out.status == "identified"
                     ? fmt::format("The gap is explained by {}.", fmt::join(out.effects, " and "))
                     : fmt::format("The gap is explained by {}, but {} would explain it about as well.",
                                   fmt::join(out.effects, " and "), fmt::join(out.confused_with, " or "));
  if (std::isfinite(gap.closed) && gap.closed < 0.8)
    out.sentence += fmt::format(" About {:.0f} % of the gap remains unexplained.", 100 * out.remaining);
  return out;
}

}  // namespace ident
