// What each set of causes would gain, by the quadratic form over all of them.
#pragma once

#include "ident/gap/hypotheses/quadratic_form.h"

namespace ident {

/// Times its physical limit, a size ends the trial of a cause. Limits are round numbers for a usual vehicle,
/// and the quadratic form is off by as much; up to here a verdict counts the size against the cause.
inline constexpr double kFarther = 3.0;

/// Times its deviation, what was stated of a constant that counts as wrong is off by as much as that; and by
/// a unit of its unknown at least (FreeConstant::unit): its value, or the typical size of one that is mostly
/// 0. A constant stated as zero to many digits would else be held there while others are blamed.
inline constexpr double kDropped = 100.0;

/// What a set of causes gains over a model with the base constants alone.
struct SetGain {
  std::vector<int> members;  ///< candidates
  double gain = 0.0;         ///< fall of the cost (twice the log likelihood)
  double degrees = 0.0;      ///< directions freed
  double price = 0.0;    ///< of the directions, in units of log likelihood: little where the data tell little
  bool signs = true;     ///< as they must be
  bool sizes = true;     ///< that physics allows
  Eigen::VectorXd step;  ///< of all unknowns at the optimum of the quadratic form

  bool physical() const { return signs && sizes; }
};
SetGain gain_of(const QuadraticForm& form, const ExtendedProblem& problem, const std::vector<int>& members);

/// Standard deviation of one direction of a candidate, everything of the base free; coloured residuals
/// counted. Of a parameter that of its difference from what is stated.
double deviation_of(const QuadraticForm& form, const ExtendedProblem& problem, int candidate, int direction);

}  // namespace ident
