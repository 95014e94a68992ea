// What a search for causes ends with, and what verdict and report ask of it.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/search/left_out.h"
#include "ident/gap/search/weigh_sets.h"
#include "ident/gap/statistics/by_channel.h"
#include "ident/gap/statistics/level_thrust.h"

namespace ident {

struct SearchStep {
  std::string name;
  double gain = 0.0;  ///< corrected for colour
};

struct SearchResult {
  FittedModel base, best;
  ExtendedProblem problem;  ///< over the best model
  QuadraticForm form;
  ExtendedProblem base_problem;
  QuadraticForm base_form;
  std::vector<WeighedSet> sets;  ///< most probable first
  std::vector<SearchStep> steps;
  std::vector<SearchStep>
      alone;  ///< what each cause found gains beside the others under the noise they leave
  std::vector<std::vector<Asked>> asked;       ///< of each cause found by the channels, one by one
  std::vector<BesideLeftOut> beside_left_out;  ///< empty where nothing was left out
  LevelThrust thrust;                          ///< what the battery does to it, whatever else is in the model
  std::vector<std::string>
      ran_away;  ///< causes that gained much and with which the full model cannot be fitted

  double probability_of(const std::string& name) const;
  /// What the causes found gain, each beside the others.
  double explained() const;
  /// Scatter of an adopted cause's value over blocks of flight, in units of what noise makes: 1 for a true
  /// cause.
  double scatter_of(const Candidate& adopted) const;
  /// What an adopted cause gains beside the others, not corrected for its scatter.
  double gain_before_scatter(const Candidate& adopted) const;
  /// By what share of itself that value changes from block to block beyond what noise makes.
  double change_of(const Candidate& adopted) const;
  /// Scatter of all candidates, the median: what the colour of the residuals alone makes.
  double usual_scatter() const;
};

/// Names of causes, each once. What one of them brings along is not named beside it: the drag through which
/// wind acts, the shift of the centre of gravity that a payload is.
std::vector<std::string> names_of(const std::vector<Candidate>& causes);

/// A cause with the direction of its rotor: "rotor_mismatch" and "rotor 2".
std::string described(const Candidate& candidate);

}  // namespace ident
