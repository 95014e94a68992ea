// Odds of each sign, and all of them together.
#include "ident/gap/verdict/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/gap/verdict/decision.h"

namespace ident {
namespace {

double probability_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

// A statistic that is normal without anything else: even odds at kBeyondChance deviations.
double log_odds_at(double deviations) {
  return deviations <= 0 ? -0.5 * kBeyondChance * kBeyondChance
                         : 0.5 * (deviations * deviations - kBeyondChance * kBeyondChance);
}

void add(Discrepancy& out, double log_odds, std::string said) {
  if (log_odds > 0) out.signs.push_back({log_odds, std::move(said)});
  out.probability = 1 - (1 - out.probability) * (1 - probability_of(log_odds));
}

// The spectral test and the test of jumps were made at one in 10^4: what they return is beyond chance. What
// shows in rotor speeds alone, beside a cause that acts there, is the form of that cause.
void add_lines(Discrepancy& out, const Rest& rest) {
  constexpr double kSame = 0.1;  // of the frequency
  constexpr std::size_t kMost = 2;
  std::vector<double> told;
  for (const SpectralLine& line : rest.lines) {
    const bool known =
        std::ranges::any_of(told, [&](double hz) { return std::abs(hz - line.hz) < kSame * line.hz; });
    if (known || told.size() == kMost || (rest.of_drive && line.channel.starts_with("omega"))) continue;
    told.push_back(line.hz);
    std::string said = fmt::format("a line at {} Hz in {}", format_number(line.hz, 3), line.channel);
    if (std::isfinite(line.rotor_hz))
      said +=
          fmt::format(" (where the {} turns a second of the rotors show)", format_number(line.rotor_hz, 3));
    add(out, std::log(1e4), std::move(said));
  }
}

// About the yaw axis gusts jump too: rotors do not share their drag alike.
void add_jumps(Discrepancy& out, const Rest& rest) {
  const auto strike = std::ranges::find_if(
      rest.jumps, [](const Burst& one) { return one.channel != "Mz" && one.plain >= 2; });
  if (strike == rest.jumps.end()) return;
  add(out, std::log(1e4),
      fmt::format("{} jumps in {}, the largest at {} s of log {}", strike->count, strike->channel,
                  format_number(strike->t, 3), strike->log + 1));
}

void add_unsteady(Discrepancy& out, const Rest& rest) {
  if (rest.unsteady.empty()) return;
  const Unsteady& most = rest.unsteady.front();
  add(out, log_odds_at(most.deviations),
      fmt::format("{} that comes and goes, {:.0f} % of it from {} to {} s of log {}", most.channel,
                  100 * most.share, format_number(most.from, 3), format_number(most.to, 3), most.log + 1));
}

}  // namespace

std::string Discrepancy::said() const {
  std::string out;
  for (const Sign& sign : signs) out += (out.empty() ? "" : "; ") + sign.said;
  return out;
}

Discrepancy discrepancy(const Rest& rest) {
  Discrepancy out;
  const double gained = rest.rival.total(), allowed = kRegressionByChance + rest.by_form,
               beyond = std::max(gained - allowed, 0.0);
  out.predictable = beyond / (beyond + std::max(rest.explained, 0.0) + kRegressionByChance);
  add(out, 0.5 * (gained - allowed),
      "a part that the flight itself predicts, most in " + rest.rival.strongest());
  add_lines(out, rest);
  add_jumps(out, rest);
  // These two only say that something is left, not what: a cause whose form is nearly right leaves as much.
  const bool material = !(rest.left < kMaterial);
  if (material) add_unsteady(out, rest);
  const double ratio = rest.gap.after / rest.gap.floor;
  if (material && std::isfinite(ratio))
    add(out, log_odds_at((ratio - 1) / kFloorKnown),
        fmt::format("{} times the noise of sensors and air on held-out flight", format_number(ratio, 2)));
  std::ranges::stable_sort(out.signs, std::greater<>(), &Sign::log_odds);
  return out;
}

}  // namespace ident
