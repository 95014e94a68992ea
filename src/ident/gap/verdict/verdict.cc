// The rules of a verdict.
#include "ident/gap/verdict/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/format_number.h"
#include "ident/gap/search/further.h"
#include "ident/gap/search/wrong_lag.h"
#include "ident/gap/verdict/against_naming.h"
#include "ident/gap/verdict/nothing_found.h"
#include "ident/gap/verdict/verdict_names.h"

namespace ident {
namespace {

// A gap of this share of the noise floor is none, and no cause of it is named: the floor is known to a tenth.
constexpr double kBelowFloor = 0.9;
// An answer of more names than this, those of how the sensor is mounted apart, is none, nor one that leaves
// open which of more it is.
constexpr std::ptrdiff_t kMostNames = 3;
constexpr double kLeftOpen = 0.95;  // of a cause no more probable than that
// Slower motors, s of lag, no multirotor flies with: a model that asks for them has left the commands aside.
constexpr double kSlowestLag = 0.2;
// And none swings with less damping: such a one does the work of something else.
constexpr double kLeastDamping = 0.2;
constexpr double kMostRemains = 0.5;

std::ptrdiff_t of_vehicle(const std::vector<std::string>& names) {
  return std::ranges::count_if(names, [](const std::string& n) { return !is_of_mounting(n); });
}

// Causes found that are not named, for the reason that the sentence gives.
Judged refusal(std::string sentence, std::vector<std::string> nearest) {
  return {.status = "unknown",
          .sentence = std::move(sentence),
          .confused_with = std::move(nearest),
          .refused = true};
}

// The names found, alone or beside those that would do as well.
Judged named_among(const std::vector<std::string>& names, const std::vector<std::string>& others,
                   const SearchResult& search) {
  const std::string found = fmt::format("{}", fmt::join(names, " and "));
  std::vector<std::string> open = names;
  std::erase_if(open, [&](const std::string& n) { return search.probability_of(n) > kLeftOpen; });
  if (of_vehicle(names) > kMostNames) {
    Judged out = refusal(
        fmt::format("A gap is there that only {} together explain: so many would fit almost anything, and "
                    "each needs a bench test of its own.",
                    found),
        names);
    out.confused_with.insert(out.confused_with.end(), others.begin(), others.end());
    return out;
  }
  if (others.empty())
    return {.status = "identified",
            .sentence = fmt::format("The gap is explained by {}.", found),
            .effects = names};
  if (std::max<std::ptrdiff_t>(of_vehicle(open), 1) + of_vehicle(others) > kMostNames) {
    Judged out{.status = "unknown",
               .sentence = fmt::format("A gap is there of which these logs do not tell the cause: {} explain "
                                       "it, but {} would about as well.",
                                       found, fmt::join(others, " or ")),
               .confused_with = names};
    out.confused_with.insert(out.confused_with.end(), others.begin(), others.end());
    return out;
  }
  const bool part = !open.empty() && open.size() < names.size();
  return {.status = "ambiguous",
          .sentence = fmt::format("The gap is explained by {}, but {}{} would explain it about as well.",
                                  found, fmt::join(others, " or "),
                                  part ? fmt::format(" in place of {}", fmt::join(open, " and ")) : ""),
          .effects = names,
          .confused_with = others};
}

// What the model found holds beside the names, and what of the gap remains.
std::string said_beside(const std::vector<std::string>& names, const SearchResult& search,
                        const GapClosed& gap, double remaining) {
  std::string out;
  std::vector<std::string> beside = names_of(search.best.adopted);
  std::erase_if(beside, [&](const auto& n) { return std::ranges::find(names, n) != names.end(); });
  if (!beside.empty())
    out +=
        fmt::format(" The model found holds {} as well, which is hardly there and mends the form of what is.",
                    fmt::join(beside, " and "));
  if (std::isfinite(gap.closed) && gap.closed < 0.8)
    out += gap.closed > 0 ? fmt::format(" About {:.0f} % of the gap remains unexplained.", 100 * remaining)
                          : " Held-out flight, where there is hardly a gap, is not predicted better for it.";
  return out;
}

Judged judge_all(const SearchResult& search, const GapClosed& gap, const Rival& rival,
                 const std::vector<SpectralLine>& lines, const std::vector<Burst>& jumps,
                 const std::vector<Parameter>& fitted) {
  if (!search.ran_away.empty())
    return {.status = "unknown",
            .sentence = fmt::format(
                "A gap is there that looks like {}, but no full model with that flies as these logs do.",
                fmt::join(search.ran_away, " or ")),
            .confused_with = search.ran_away};
  const std::vector<std::string> names = probable_names(search, fitted);
  if (names.empty()) {
    Judged out = nothing_found(gap, rival, lines, jumps, fitted);
    if (out.status == "unknown") out.confused_with = likely_names(search);
    return out;
  }
  if (!gap.held_out)
    return refusal(
        fmt::format(
            "{} would explain these logs, but they, or their pieces, are too short for flight to be held out "
            "on which that could be tried: fly for longer, 40 s or more.",
            fmt::join(names, " with ")),
        names);
  const double remaining = std::isfinite(gap.closed) ? std::max(0.0, 1 - gap.closed) : kNaN;
  Judged out;
  if (const std::string why = against_naming(search, gap, rival, lines, jumps, fitted); !why.empty()) {
    out =
        refusal(fmt::format("A gap is there that the catalogue does not explain. The nearest is {}, but {}.",
                            fmt::join(names, " with "), why),
                names);
  } else {
    out = named_among(names, names_in_place_of(names, search, fitted), search);
    out.sentence += said_beside(names, search, gap, remaining);
  }
  out.remaining = remaining;
  return out;
}

// A cause that is there whatever else is, and what is said of it.
struct PlainCause {
  std::string name, sentence;
};

// The motors' lag where it was found wrong by more than anything else that a model lacks would make of it.
// Where speeds were measured they show whether it is the lag: it leaves nothing of them to predict.
const Parameter* plainly_wrong_lag(const SearchResult& search, const Rival& rival,
                                   const std::vector<Parameter>& fitted) {
  double of_speeds = 0;
  for (const auto& [channel, gain] : rival.sensors)
    if (channel == "motors" || channel.starts_with("omega")) of_speeds += std::max(gain, 0.0);
  if (of_speeds > kRivalGain) return nullptr;
  const auto is_it = [](const Candidate& c) { return c.name == "parameter:omega_m"; };
  const auto omega_m = std::ranges::find(fitted, "omega_m", &Parameter::name);
  const auto zeta_m = std::ranges::find(fitted, "zeta_m", &Parameter::name);
  if (std::ranges::none_of(search.best.adopted, is_it) || omega_m == fitted.end() || zeta_m == fitted.end() ||
      !omega_m->prior_value)
    return nullptr;
  // Motors may come out as much faster than any row could show.
  constexpr double kCertain = 4.0;  // of its standard deviations
  if (!(std::abs(omega_m->value - *omega_m->prior_value) > kCertain * omega_m->std)) return nullptr;
  const bool flies = 2 * zeta_m->value / omega_m->value < kSlowestLag && zeta_m->value > kLeastDamping;
  return flies && lag_beyond_physics(omega_m->value, *omega_m->prior_value) ? &*omega_m : nullptr;
}

std::vector<PlainCause> plain_causes(const SearchResult& search, const Rival& rival,
                                     const std::vector<Parameter>& fitted) {
  std::vector<PlainCause> out;
  if (const Parameter* lag = plainly_wrong_lag(search, rival, fitted))
    out.push_back({"parameter:omega_m",
                   fmt::format("The motors are not what was stated: omega_m is {} rad/s instead of {}, and "
                               "nothing else that a model can lack makes such a difference.",
                               format_number(lag->value, 3), format_number(*lag->prior_value, 3))});
  const bool battery =
      std::ranges::any_of(search.best.adopted, [](const Candidate& c) { return c.name == "battery_sag"; });
  if (const LevelThrust& seen = search.thrust; battery && seen.plain())
    out.push_back(
        {"battery_sag",
         fmt::format(
             "The battery shows in {} logs of {}: thrust for the same commands varies by {:.1f} %, by "
             "{:.1f} % where rotor speeds go with the voltage to the power of {}.",
             seen.rising, seen.logs, 100 * seen.varies, 100 * seen.left, format_number(seen.n, 2))});
  return out;
}

}  // namespace

Judged judge(const SearchResult& search, const GapClosed& gap, const Rival& rival,
             const std::vector<SpectralLine>& lines, const std::vector<Burst>& jumps,
             const std::vector<Parameter>& fitted) {
  Judged out = judge_all(search, gap, rival, lines, jumps, fitted);
  if (!out.effects.empty() && gap.before < kBelowFloor * gap.floor)
    return {.status = "none",
            .sentence =
                fmt::format("The model as given predicts held-out flight to within its noise: there is no "
                            "gap. What speaks for {} is less than that.",
                            fmt::join(out.effects, " with ")),
            .refused = true};
  const std::vector<PlainCause> plain = plain_causes(search, rival, fitted);
  if (plain.empty() || out.status != "unknown" || (std::isfinite(gap.closed) && gap.ci95[1] < kMostRemains))
    return out;
  // What else is there, and whether it can be told, changes nothing of these.
  const std::string rest = std::exchange(out.sentence, {});
  out.status = "identified", out.plain = true, out.effects.clear(), out.confused_with.clear();
  if (std::isfinite(gap.closed)) out.remaining = std::max(0.0, 1 - gap.closed);
  for (const PlainCause& cause : plain) {
    out.effects.push_back(cause.name);
    out.sentence += cause.sentence + " ";
  }
  out.sentence += "With that alone the gap is not explained. " + rest;
  return out;
}

Judged unnamed(Judged verdict) {
  verdict.confused_with.insert(verdict.confused_with.begin(), verdict.effects.begin(), verdict.effects.end());
  verdict.refused = !verdict.effects.empty();
  verdict.effects.clear();
  verdict.status = "unknown";
  return verdict;
}

nlohmann::ordered_json to_json(const Judged& verdict) {
  nlohmann::ordered_json out = {{"status", verdict.status},
                                {"effects", verdict.effects},
                                {"confused_with", verdict.confused_with},
                                {"sentence", verdict.sentence}};
  if (std::isfinite(verdict.remaining)) out["remaining"] = verdict.remaining;
  return out;
}

}  // namespace ident
