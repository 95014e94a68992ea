// What one more cause gains where a search stands, and how it fares tried in full.
#pragma once

#include <optional>
#include <string>

#include "ident/gap/hypotheses/next_model.h"

namespace ident {

/// By how much coloured residuals, or a size that changes from block to block, inflate what a cause gains.
double own_stretch(const QuadraticForm& form, const Candidate& cause);

/// What a cause gains beside others, by the quadratic form.
struct Further {
  int candidate = -1;
  double gain = 0, price = 0, stretch = 1, degrees = 0;
  bool possible = false;  ///< its size is one that physics allows
  bool beyond = false;    ///< only too large

  /// Fall of the cost, corrected for colour.
  double honest() const { return gain / stretch; }
  /// Whether it explains enough to be adopted: 1 % family-wise over the catalogue.
  bool passes() const;
};

/// `candidate` beside `have`, those that the model has without it.
Further further(const Standing& at, const std::vector<int>& have, int candidate);

/// A cause where it acts: with it in the model, fitted and linearised again.
struct InFull {
  Standing at;
  Further own;  ///< what it gains there beside the others
};
/// None where the model with that cause cannot be fitted.
std::optional<InFull> tried_in_full(const FlightRecord& record, const Vehicle& vehicle,
                                    const std::vector<std::string>& exclude, const Standing& at_now,
                                    int chosen, const FlightFitOptions& options);

/// A cause that moves masses about as something bolted on would, and is not that itself.
bool moves_mass(const Candidate& cause);

/// How the sensor is mounted: it changes what is seen and not how the vehicle flies, and every real vehicle
/// has some of it. Such causes come on top of those asked for.
bool is_of_mounting(const std::string& cause);

/// One of the two constants of the motors' lag stated wrongly: they are one thing.
bool is_lag(const std::string& cause);

/// Two causes that move masses may be one payload, which shows its inertia only where it acts: tried at
/// `from`, without those of them that it has. None unless it stands and none of `instead_of` gains beside it.
std::optional<InFull> payload_instead(const FlightRecord& record, const Vehicle& vehicle,
                                      const std::vector<std::string>& exclude, const Standing& from,
                                      const std::vector<Candidate>& instead_of,
                                      const FlightFitOptions& options);

}  // namespace ident
