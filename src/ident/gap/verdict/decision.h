// What is at stake in a verdict, and the numbers that decide what is said: all of them are here.
#pragma once

namespace ident {

/// Losses of a verdict, in units of a missed name. A wrong name sends somebody to mend what is not broken; a
/// gap that is claimed and not there costs a flight to look for it.
struct Losses {
  double wrong_name = 4.0, missed_name = 1.0;
  double false_alarm = 4.0, missed_gap = 1.0;
};
inline constexpr Losses kLosses;

/// Probability from which saying it loses less than not saying it.
constexpr double worth_saying(double lost_if_wrong, double lost_if_missed) {
  return lost_if_wrong / (lost_if_wrong + lost_if_missed);
}
inline constexpr double kNamed = worth_saying(kLosses.wrong_name, kLosses.missed_name);    // 0.8
inline constexpr double kClaimed = worth_saying(kLosses.false_alarm, kLosses.missed_gap);  // 0.8

/// Probability of a set in the place of the one named from which its causes are told of, and of a cause below
/// which it only mends the form of those found. [-] 1 in 20: as a reader of a 95 % interval expects.
inline constexpr double kTold = 0.05;

/// Share of what is known of a constant from which the flight has told something of it. [-] One in 20, as
/// kTold.
inline constexpr double kHeard = 0.05;

/// Share of the gap from which what is left is spoken of. [-] Of a tenth an engineer would go on looking.
inline constexpr double kMaterial = 0.1;

/// Share from which a sentence speaks of most of the gap. [-] Half; it decides words only.
inline constexpr double kMostly = 0.5;

/// What the regression on the flight gains on flights that lack nothing, at most in one of a hundred. [fall
/// of the cost] 400 flights without effect, tests/withheld seed 1919.
inline constexpr double kRegressionByChance = 45.0;

/// By how much of itself a true floor of held-out flight is missed, a standard deviation. [-] One in ten of
/// 400 flights without effect misses it by a tenth and more, none by more than 0.53 (tests/withheld).
inline constexpr double kFloorKnown = 0.17;

/// Standard deviations beyond which chance has no part. [-] 1 in 10^4 over some hundred looks.
inline constexpr double kBeyondChance = 5.0;

}  // namespace ident
