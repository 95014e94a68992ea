// A ladder of models of one vehicle, judged by held-out flight: the highest that does no harm is taken.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ident/flight/ladder/held_out_errors.h"
#include "ident/flight/ladder/rungs.h"
#include "ident/result/correlation.h"

namespace ident {

/// Share of the error without a model, or of what was gained over a window, below which inputs explain how a
/// vehicle turned: half of its square is explained.
inline constexpr double kExplains = 0.7;

/// A constant that a rung has estimated.
struct RungConstant {
  std::string name;
  double value = 0.0, std = 0.0;
  std::optional<double> prior_std;  ///< with which it was stated
  double prior_value = 0.0;
  FitTo of = FitTo::forces;  ///< to which side it was fitted
};

/// Root mean square errors, [metric][horizon]; NaN where not logged.
using ErrorTable = std::array<std::array<double, kLadderHorizons.size()>, kMetrics>;

/// Why a rung is not stood on.
enum class Refusal {
  none,
  worse,        ///< it predicts held-out flight worse than a lower one
  beyond,       ///< it asks for a constant that no such vehicle has
  unexplained,  ///< what was logged of the rotors does not explain how the vehicle turned
};

struct RungResult {
  Rung rung = Rung::stated;
  std::vector<double> p, trained;       ///< the model's constants by all flight, and by the first part
  std::vector<RungConstant> constants;  ///< estimated on this rung and those below it that are stood on
  Correlation correlation;              ///< of those
  ErrorTable error{};                   ///< on held-out flight, fitted to the rest
  Refusal refusal = Refusal::none;
  Rung than = Rung::stated;          ///< worse than that one
  Metric metric = Metric::velocity;  ///< in that
  std::size_t horizon = 0;           ///< at that one of kLadderHorizons
  std::vector<std::string> beyond;   ///< constants beyond their limits
};

struct LadderResult {
  std::vector<RungResult> rungs;  ///< the stated one first
  std::size_t chosen = 0;         ///< the highest that is stood on
  ErrorTable persistence{};       ///< errors of no model: velocity and rates stay what they were
  double seconds = 0.0;           ///< of held-out flight
  /// What was logged of the rotors does not say how the vehicle turned: no rung explains half of it.
  bool moments_unexplained = false;
  /// The same, and nothing confirms what turned the vehicle: commands and speeds were not both logged.
  bool misses_turning = false;
  bool rotor_speeds = false;  ///< were logged: what turned the vehicle was not hidden behind commands
};

/// The refined model: its constants by the flight before what is held out, and by all.
struct FullModel {
  std::vector<double> of_training, of_all;
};

/// Climbs from what the record's vehicle states. Each rung adds constants to the highest that is stood on,
/// and is stood on if no error is greater than that of a lower one beyond chance. An error of turning, or of
/// what follows from it, judges nothing where the lower rung explains less than half of it: the inputs do not
/// tell it, on either rung. Nothing where the logs tell of neither forces nor moments, or hold too little
/// flight.
std::optional<LadderResult> climb_ladder(const FlightRecord& record);

/// Adds the refined model as the last rung, judged in the same way.
void judge_full(LadderResult& ladder, const FlightRecord& record, const FullModel& full);

}  // namespace ident
