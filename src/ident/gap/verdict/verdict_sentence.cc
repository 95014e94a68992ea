// One sentence for each status, and one for each thing beside it.
#include "ident/gap/verdict/verdict_sentence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "ident/core/format_number.h"
#include "ident/core/word_list.h"
#include "ident/effects/cause_traits.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

constexpr double kPlainGap = 2.0;  // times the noise, of the model as stated

std::string percent(const Share& share) {
  const auto in_100 = [](double x) { return std::round(100 * x) + 0.0; };  // no -0
  if (!std::isfinite(share.ci95[0])) return fmt::format("{:.0f} %", in_100(share.value));
  return fmt::format("{:.0f} % [{:.0f}, {:.0f}]", in_100(share.value), in_100(share.ci95[0]),
                     in_100(share.ci95[1]));
}

// "battery_sag (77 % [70, 84] of the gap) and rotor_drag". `of`: what they share.
std::string named(const std::vector<std::string>& names, const Judged& verdict, std::string_view of) {
  std::vector<std::string> out;
  for (const std::string& name : names) {
    out.push_back(name);
    for (const JudgedCause& cause : verdict.causes)
      if (cause.evidence.name == name && std::isfinite(cause.share.value))
        out.back() += traits_of(name).of_mounting && cause.share.value < kMaterial
                          ? " (changes readings, not the flight)"
                          : fmt::format(" ({} of the {})", percent(cause.share), of);
  }
  return listed(out);
}

std::string left(const Judged& verdict) {
  if (verdict.rest.signs.empty()) return {};
  return fmt::format(" What is left: {}.", verdict.rest.said());
}

std::string missed(const GapClosed& gap) {
  const double ratio = gap.after / gap.floor;
  if (!std::isfinite(ratio)) return {};
  return fmt::format(" Half a second ahead the model misses {} times the noise of sensors and air.",
                     format_number(ratio, 2));
}

double change_of(const Parameter& p) { return p.value / *p.prior_value - 1; }

// kT km^2, the thrust at a command, where flight tells that and not the two apart.
std::optional<double> change_of_thrust(const std::vector<Parameter>& fitted) {
  const auto kT = std::ranges::find(fitted, "kT", &Parameter::name),
             km = std::ranges::find(fitted, "km", &Parameter::name);
  if (kT == fitted.end() || km == fitted.end() || !kT->prior_value || !km->prior_value) return {};
  if (kT->identifiable && km->identifiable) return {};
  return (1 + change_of(*kT)) * std::pow(1 + change_of(*km), 2) - 1;
}

// " (Jxx +12 %, kT km^2 -5 %)": the constants that the flight moves farthest from what was stated, beyond
// their deviations.
std::string moved(const std::vector<Parameter>& fitted) {
  constexpr double kLeast = 0.02, kTold = 2.0;  // of the value; standard deviations
  constexpr std::size_t kMost = 3;
  std::vector<std::pair<double, std::string>> all;
  const std::optional<double> thrust = change_of_thrust(fitted);
  if (thrust && std::abs(*thrust) > kLeast) all.emplace_back(*thrust, "kT km^2");
  for (const Parameter& p : fitted) {
    if (!(p.identifiable || p.joint) || !p.prior_value || !(*p.prior_value != 0)) continue;
    if (thrust && (p.name == "kT" || p.name == "km")) continue;
    if (std::abs(change_of(p)) > kLeast && std::abs(p.value - *p.prior_value) > kTold * p.std)
      all.emplace_back(change_of(p), p.name);
  }
  std::ranges::sort(all, std::greater{}, [](const auto& one) { return std::abs(one.first); });
  if (all.size() > kMost) all.resize(kMost);
  std::vector<std::string> out;
  for (const auto& [change, name] : all) out.push_back(fmt::format("{} {:+.0f} %", name, 100 * change));
  return out.empty() ? "" : fmt::format(" ({})", fmt::join(out, ", "));
}

// What constants close of the gap, where that is most of it; else nothing.
std::string by_constants(const Seen& seen) {
  const double closed = closed_by_constants(seen.shares, seen.gap);
  if (!(closed > kMostly)) return {};
  return fmt::format("Constants, refitted within what is known of them{}, close {:.0f} % of the gap. ",
                     moved(seen.fitted), std::floor(100 * closed));
}

std::string unknown(const Judged& verdict, const Seen& seen) {
  std::string out = by_constants(seen);
  out += out.empty() ? "Something acts on this vehicle of which no cause of the catalogue is certain."
                     : "Of what is left no cause of the catalogue is certain.";
  if (!verdict.causes.empty()) {
    std::vector<std::string> nearest;
    for (const JudgedCause& cause : verdict.causes)
      if (std::ranges::find(verdict.minor, cause.evidence.name) == verdict.minor.end())
        nearest.push_back(fmt::format("{} (probability {:.2f})", cause.evidence.name, cause.probability()));
    if (!verdict.minor.empty())
      out += fmt::format(" {} {} too little to be the answer.", named(verdict.minor, verdict, "gap"),
                         verdict.minor.size() > 1 ? "are" : "is");
    if (!nearest.empty())
      out += fmt::format(" The nearest is {}: it would act like this, and more speaks against it.",
                         fmt::join(nearest, " with "));
  }
  if (!seen.search.ran_away.empty())
    out += fmt::format(" No model with {} could be flown along these logs.",
                       fmt::join(seen.search.ran_away, " or "));
  return out + left(verdict) + (verdict.rest.signs.empty() ? missed(seen.gap) : "");
}

std::string none(const Seen& seen) {
  const double ratio = seen.gap.after / seen.gap.floor;
  const double as_stated = seen.gap.before / seen.gap.floor;
  std::string out = as_stated > kPlainGap
                        ? fmt::format("With constants refitted within what is known of them{}, the model",
                                      moved(seen.fitted))
                        : "The model";
  out += " explains these logs down to the noise of the sensors and the air; no cause stands out.";
  if (std::isfinite(ratio) && ratio > 1 + kFloorKnown)
    out += fmt::format(" Held-out flight is missed by {} times that noise, as chance may have it.",
                       format_number(ratio, 2));
  if (!seen.gap.held_out)
    out +=
        " They, or their pieces, are too short for flight to be held out: what they do not show may well "
        "be there, up to the sizes given.";
  return out;
}

}  // namespace

std::string sentence_of(const Judged& verdict, const Seen& seen) {
  std::string out;
  if (verdict.status == "none") {
    out = none(seen);
  } else if (verdict.status == "unknown") {
    out = unknown(verdict, seen);
  } else {
    out = by_constants(seen);
    const std::string_view of = out.empty() ? "gap" : "rest";
    const std::string causes = named(verdict.effects, verdict, of);
    if (verdict.status == "partly")
      out += fmt::format("There is {}, and something else is left.", causes);
    else if (verdict.status == "identified")
      out += verdict.remaining.value > kMostly ? fmt::format("There is {}.", causes)
                                               : fmt::format("The {} is explained by {}.", of, causes);
    else
      out += fmt::format("The {} is explained by {}, but {} would explain it about as well.", of, causes,
                         fmt::join(verdict.confused_with, " or "));
    if (verdict.remaining.value > kMaterial)
      out += fmt::format(" {} of the {} remains{}.", percent(verdict.remaining), of,
                         verdict.status == "identified" ? ", which is not told from gusts and noise" : "");
    std::vector<std::string> like;
    for (const JudgedCause& cause : verdict.causes)
      if (std::ranges::find(verdict.effects, cause.evidence.name) == verdict.effects.end())
        like.push_back(cause.evidence.name);
    if (!like.empty()) out += fmt::format(" Part of what is left acts like {}.", listed(like));
    if (verdict.status != "identified") out += left(verdict);
  }
  for (const Contradiction& one : verdict.findings) out += " Beside that, " + in_words(one) + ".";
  return out;
}

}  // namespace ident
