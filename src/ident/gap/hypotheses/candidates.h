// The causes that a diagnosis tries: effects (one entry for each rotor where it names one) and wrong
// parameters.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/refine.h"

namespace ident {

/// A cause as directions of the extended problem.
struct Candidate {
  std::string name;             ///< rotor_drag, parameter:km
  std::vector<int> directions;  ///< unknowns of the extended problem that it frees
  int parameter = -1;           ///< the unknown whose prior it drops; -1 for an effect
  int rotor = -1;               ///< 0 based, where the effect names one
  bool positive = false;        ///< its first direction has a physical sign
  /// Of a payload to first order: mass that it has at least for a shift of the centre of gravity, kg/m.
  double mass_for_shift = 0.0;
  /// The unknown of a centre of gravity's shift along z, and how far that may be, m; -1 where it has none.
  int height = -1;
  double highest = 0.0;
};

/// Whether unknown i, which is that constant, is one of the cause's.
bool is_constant_of(const Candidate& cause, const FreeConstant& constant, int i);

/// Value of that constant without the cause: what was stated of it, or where the effect is absent.
double value_without(const Candidate& cause, const FreeConstant& constant);

/// Base constants followed by the directions of every effect, and the candidates over them.
struct ExtendedProblem {
  std::vector<FreeConstant> constants;
  int base = 0;  ///< number of base constants
  std::vector<Candidate> candidates;
};

/// How far from the origin something may be bolted on, m: twice as far as the farthest rotor.
double payload_reach(const Vehicle& vehicle);

/// Whether the vehicle file states this effect: then it is part of the model, no cause to be found.
bool states_effect(const Vehicle& vehicle, std::string_view effect);

/// The same for the effect of this constant; of an effect at single rotors, for that rotor.
bool states_constant(const Vehicle& vehicle, std::string_view name);

/// The vehicle with a deviation for every size of an effect that its file states without one: the digits that
/// such sizes are given with. A wrong one is a cause then like any constant, `parameter:rotor_drag.kd`.
Vehicle with_doubted_effects(Vehicle vehicle);

/// `base` are the constants of the current model (effects already adopted included), `exclude` names of
/// causes that must not be tried.
ExtendedProblem extended_problem(const Vehicle& vehicle, const std::vector<double>& p, const Signals& signals,
                                 const std::vector<FreeConstant>& base,
                                 const std::vector<std::string>& exclude);

/// Constants of an adopted cause in the full model (starting values in p units), with a payload's place free.
/// Where commands are all that is known of the rotors, the size of what turns with them is free times km:
/// else a strong effect could be made up for by a km that goes along a straight line to nothing.
std::vector<FreeConstant> constants_of(const Candidate& candidate, const Vehicle& vehicle,
                                       const std::vector<double>& p, const Signals& signals);

}  // namespace ident
