// The motors' lag, stated with confidence and far from the truth, bends every other constant before it moves:
// from there no small step shows what is wrong. All other constants act on a flight in proportion.
#pragma once

#include <optional>

#include "ident/gap/hypotheses/next_model.h"

namespace ident {

/// A model with omega_m free, all other constants back at what was stated before the fit.
struct WrongLag {
  Candidate cause;
  FittedModel model;
  double gain = 0.0;  ///< fall of the cost, priors included, below that of the model at hand
};

/// Whether a natural frequency of the motors is so far off the stated one that nothing else that a model
/// lacks makes the difference.
bool lag_beyond_physics(double found, double stated);

/// Whether the flight pulls omega_m or zeta_m more than five standard deviations off what was stated.
bool lag_pulled_far(const FittedModel& model);

/// Whether the flight leaves both within three standard deviations of what was stated.
bool lag_as_stated(const FittedModel& model);

/// Where the model at hand pulls omega_m or zeta_m far off what was stated: the fit from the best of a wide
/// range of omega_m, if it gains and ends so far off the stated value that no physics that the model lacks
/// makes the difference. `p`: constants as stated.
std::optional<WrongLag> wrong_lag(const FlightRecord& record, const std::vector<double>& p,
                                  const FittedModel& at_hand, const ExtendedProblem& problem,
                                  const QuadraticForm& form, const FlightFitOptions& options);

/// Whether with the motors' lag held where it was stated some other cause gains more than holding it costs:
/// then the lag that the flight asks for does that cause's work. Both without causes.
bool shows_more(const Standing& held, const Standing& at_hand, double costs);

/// By how much the flight fits worse with the lag held, under the noise that is left there.
double cost_of_holding(const FlightRecord& record, const Standing& held, const Standing& at_hand);

}  // namespace ident
