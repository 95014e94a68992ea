// The decision: probabilities of names and of something else against what it costs to be wrong.
#include "ident/gap/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "ident/effects/cause_traits.h"
#include "ident/gap/search/further.h"
#include "ident/gap/search/wrong_lag.h"
#include "ident/gap/verdict/decision.h"
#include "ident/gap/verdict/in_their_place.h"
#include "ident/gap/verdict/verdict_sentence.h"

namespace ident {
namespace {

bool is_among(const std::string& name, const std::vector<std::string>& names) {
  return std::ranges::find(names, name) != names.end();
}

Share share_of(const std::string& name, const GapShares& shares) {
  const auto at = std::ranges::find(shares.causes, name, &CauseShare::name);
  return at == shares.causes.end() ? Share{} : at->share;
}

// A cause of the lag as far from what was stated as nothing else that a model lacks makes of it.
bool is_beyond_physics(const std::string& name, const std::vector<Parameter>& fitted) {
  constexpr double kSlowestLag = 0.2;    // s: no multirotor flies with slower motors
  constexpr double kLeastDamping = 0.2;  // and none swings with less
  constexpr double kCertain = 4.0;       // standard deviations
  const auto omega_m = std::ranges::find(fitted, "omega_m", &Parameter::name);
  const auto zeta_m = std::ranges::find(fitted, "zeta_m", &Parameter::name);
  if (!traits_of(name).of_lag || omega_m == fitted.end() || zeta_m == fitted.end() || !omega_m->prior_value)
    return false;
  return std::abs(omega_m->value - *omega_m->prior_value) > kCertain * omega_m->std &&
         2 * zeta_m->value / omega_m->value < kSlowestLag && zeta_m->value > kLeastDamping &&
         lag_beyond_physics(omega_m->value, *omega_m->prior_value);
}

// Causes found, the strongest evidence first. One that the sets hold for improbable beside the others only
// mends their form.
std::vector<JudgedCause> causes_of(const Seen& seen) {
  std::vector<JudgedCause> out;
  for (const std::string& name : names_of(seen.search.best.adopted)) {
    JudgedCause cause{evidence_of(name, {seen.search, seen.shares, seen.rival, seen.fitted}),
                      seen.search.probability_of(name), 0, share_of(name, seen.shares)};
    cause.right = probability_right(cause.evidence);
    const bool beyond_physics = is_beyond_physics(name, seen.fitted);
    if (beyond_physics) cause.right = std::max(cause.right, kNamed * cause.evidence.beside_left_out);
    // Sets are compared near the fit; so far away they do not reach.
    if (cause.evidence.seen || beyond_physics) cause.in_sets = 1;
    out.push_back(std::move(cause));
  }
  return out;
}

// What the causes named leave: of those found the others are part of it.
Share left_by(const std::vector<std::string>& named, const GapShares& shares) {
  Share out = shares.remaining;
  for (const CauseShare& c : shares.causes)
    if (!is_among(c.name, named)) {
      out.value += c.share.value;
      for (std::size_t i = 0; i < 2; ++i) out.ci95[i] += c.share.value;
    }
  return out;
}

// Whether a cause closes some of the gap of held-out flight beyond chance, named with causes that leave so
// much. What does not is no cause of the gap, whatever its evidence on the flight that it was fitted to.
// Where nothing material is left, shares are too small to tell; and what only changes readings moves no
// vehicle.
bool closes_some(const JudgedCause& cause, const Share& left) {
  if (cause.evidence.seen || traits_of(cause.evidence.name).of_mounting ||
      !std::isfinite(cause.share.value) || left.value < kMaterial)
    return true;
  return cause.share.ci95[0] > 0 && left.value < 1;
}

// Whether the causes named may close a tenth of the gap between them, where more than that is left: causes
// that do not are no answer to what it is. Without shares to tell by they may.
bool may_be_material(const Judged& verdict, const Share& left) {
  double most = 0;
  for (const JudgedCause& cause : verdict.causes) {
    if (!is_among(cause.evidence.name, verdict.effects)) continue;
    if (cause.evidence.seen || traits_of(cause.evidence.name).of_mounting ||
        !std::isfinite(cause.share.ci95[1]))
      return true;
    most += cause.share.ci95[1];
  }
  return most >= kMaterial || !(left.value >= kMaterial);
}

}  // namespace

Judged judge(const Seen& seen) {
  Judged out;
  out.causes = causes_of(seen);
  const bool of_drive = std::ranges::any_of(seen.search.best.adopted, [](const Candidate& c) {
    return traits_of(c.name).of_drive || traits_of(c.name).of_motors;
  });
  out.rest = discrepancy({seen.gap, seen.rival, seen.lines, seen.jumps, seen.unsteady,
                          seen.search.explained(), left_by_form(seen.search), of_drive,
                          out.causes.empty() ? 1.0 : seen.shares.remaining.value});
  const bool something_else = out.rest.probability >= kClaimed;
  for (const JudgedCause& cause : out.causes)
    if (cause.right >= kNamed && cause.in_sets >= kTold) out.effects.push_back(cause.evidence.name);
  const Share left = left_by(out.effects, seen.shares);
  std::vector<std::string> closing;  // of all found
  for (const JudgedCause& cause : out.causes)
    if (closes_some(cause, left)) closing.push_back(cause.evidence.name);
  std::erase_if(out.effects, [&](const std::string& name) { return !is_among(name, closing); });
  if (seen.by_side && !may_be_material(out, left)) out.minor = std::exchange(out.effects, {});
  std::vector<std::string> found, by_sets;
  for (const JudgedCause& cause : out.causes) {
    found.push_back(cause.evidence.name);
    if (is_among(found.back(), out.effects) && !cause.evidence.seen) by_sets.push_back(found.back());
  }
  // In the place of those named: sets with others, about as probable. What the sets did not have to show (the
  // battery in the thrust) has nothing in its place.
  if (!by_sets.empty()) out.confused_with = in_their_place(by_sets, seen.search, seen.fitted);
  std::erase_if(out.confused_with, [&](const std::string& name) { return is_among(name, out.effects); });
  // A cause that was tried beside them and closes nothing closes nothing in their place either.
  std::erase_if(out.confused_with,
                [&](const std::string& name) { return is_among(name, found) && !is_among(name, closing); });
  out.remaining = left_by(out.effects, seen.shares);
  out.findings = contradictions(seen.fitted, found);
  if (out.effects.empty()) {
    const bool claimed =
        something_else || !out.causes.empty() || !seen.search.ran_away.empty() || !out.findings.empty();
    out.status = claimed ? "unknown" : "none";
    if (claimed) out.confused_with = nearest_names(seen.search);
  } else if (!out.confused_with.empty()) {
    out.status = "ambiguous";
  } else {
    const bool others =
        std::ranges::any_of(closing, [&](const std::string& name) { return !is_among(name, out.effects); });
    out.status = something_else || others ? "partly" : "identified";
  }
  out.sentence = sentence_of(out, seen);
  return out;
}

Judged unnamed(Judged verdict, const std::vector<std::string>& causes) {
  const auto is_one = [&](const std::string& name) { return is_among(name, causes); };
  std::vector<std::string> nearest;
  std::ranges::copy_if(verdict.effects, std::back_inserter(nearest), is_one);
  std::erase_if(verdict.effects, is_one);
  verdict.confused_with.insert(verdict.confused_with.begin(), nearest.begin(), nearest.end());
  for (JudgedCause& cause : verdict.causes)
    if (is_one(cause.evidence.name)) cause.right = std::min(cause.right, 1 - kNamed);
  if (verdict.effects.empty())
    verdict.status = "unknown";
  else if (verdict.status == "identified")
    verdict.status = "partly";
  return verdict;
}

Judged unnamed(Judged verdict) {
  const std::vector<std::string> all = verdict.effects;
  return unnamed(std::move(verdict), all);
}

}  // namespace ident
