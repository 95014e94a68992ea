// One sign after the other, in words.
#include "ident/gap/verdict/nothing_found.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ident/core/format_number.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/gap/verdict/against_naming.h"

namespace ident {
namespace {

// A share of what the model misses as given that its constants, refitted, take away.
constexpr double kOfConstants = 0.5;
// Times the noise floor of what is missed on held-out flight with no cause found: in 400 flights without one
// the most was 1.53.
constexpr double kAboveFloor = 2.0;

// How far refitted constants went from what was stated of them.
std::string from_what_was_stated(const std::vector<Parameter>& fitted) {
  const auto size = [](const Parameter& p) { return disagrees(p) ? std::abs(*p.pull) : 0.0; };
  const auto most = std::ranges::max_element(fitted, {}, size);
  if (most == fitted.end() || size(*most) == 0) return "within what was stated of them";
  return fmt::format("{} by {:.1f} standard deviations of what was stated of it", most->name, size(*most));
}

// To what the model explains the logs.
std::string remaining_noise(const GapClosed& gap) {
  constexpr double kAtTheNoise = 1.1;
  const double ratio = gap.after / gap.floor;
  return ratio > kAtTheNoise ? fmt::format("{:.1f} times their noise", ratio) : "the noise";
}

}  // namespace

Judged nothing_found(const GapClosed& gap, const Rival& rival, const std::vector<SpectralLine>& lines,
                     const std::vector<Burst>& jumps, const std::vector<Parameter>& fitted) {
  Judged out{.status = "unknown"};
  const auto strike =
      std::ranges::find_if(jumps, [](const Burst& one) { return one.channel != "Mz" && one.plain >= 2; });
  const auto about_z = std::ranges::find(jumps, std::string("Mz"), &Burst::channel);
  if (rival.total() > kRivalGain)
    out.sentence = fmt::format(
        "Something acts on this vehicle that no single cause of the catalogue explains: what the model "
        "misses, most in {}, can be predicted from the flight itself.",
        rival.strongest());
  else if (!lines.empty() && std::isfinite(lines[0].rotor_hz))
    out.sentence = fmt::format(
        "Something vibrates at {} Hz (seen in {}), which is where the {} turns a second of the rotors show: "
        "a propeller out of balance, or a sensor that feels all of them. Balance the propellers, or log what "
        "went through a filter.",
        format_number(lines[0].hz, 3), lines[0].channel, format_number(lines[0].rotor_hz, 3));
  else if (!lines.empty())
    out.sentence = fmt::format(
        "Something swings or vibrates at {} Hz (seen in {}) that no cause of the catalogue explains: a "
        "slung or loose load, a flexible arm, a propeller out of balance.",
        format_number(lines[0].hz, 3), lines[0].channel);
  else if (strike != jumps.end())
    out.sentence = fmt::format(
        "Something strikes this vehicle at moments (seen in {}, most at {} s of log {}): the wash of "
        "another vehicle, a touch, a part that comes loose. No cause of the catalogue does that.",
        strike->channel, format_number(strike->t, 3), strike->log + 1);
  else if (const Parameter* p = contradicted(fitted, [](const std::string&) { return false; }))
    out.sentence = fmt::format(
        "The flight contradicts the value of {} known beforehand by {:.0f} standard deviations, and no cause "
        "explains why.",
        p->name, std::abs(*p->pull));
  else if (gap.after > kAboveFloor * gap.floor)
    out.sentence = fmt::format(
        "The model misses these logs by {} times their noise, and no cause that was tried explains it.",
        format_number(gap.after / gap.floor, 2));
  else if (gap.closed > kOfConstants)
    out = {.status = "none",
           .sentence =
               fmt::format("No cause stands out: with its constants refitted, {}, the model explains these "
                           "logs down to {}.",
                           from_what_was_stated(fitted), remaining_noise(gap))};
  else
    out = {.status = "none",
           .sentence =
               "The model explains these logs down to " + remaining_noise(gap) + "; no cause stands out."};
  if (out.status == "none" && !gap.held_out)
    out.sentence +=
        " They, or their pieces, are too short for flight to be held out: what they do not show may well be "
        "there, up to the "
        "sizes given.";
  if (out.status == "none" && about_z != jumps.end())
    out.sentence +=
        fmt::format(" Moments about the yaw axis jump, most at {} s of log {}, as gusts make them.",
                    format_number(about_z->t, 3), about_z->log + 1);
  else if (out.status == "none" && !jumps.empty())
    out.sentence += fmt::format(
        " {} jumps, most at {} s of log {}, by no more than a sudden drive between two samples of the "
        "measured "
        "speeds makes.",
        jumps[0].channel, format_number(jumps[0].t, 3), jumps[0].log + 1);
  return out;
}

}  // namespace ident
