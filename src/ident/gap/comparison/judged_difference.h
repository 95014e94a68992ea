// The verdict on a comparison, from the verdicts on both sides and what differs between their constants.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ident/gap/comparison/differences.h"
#include "ident/gap/diagnose.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

/// Causes that the diagnosis names, at their rotors: name and rotor of a candidate only.
std::vector<Candidate> named_causes(const Diagnosis& diagnosis, const Vehicle& stated);

/// Those of them with a material share of the gap.
std::set<std::string> material_causes(const Diagnosis& diagnosis);

/// Whether something acts in these logs of which no cause is certain.
bool has_rest(const Diagnosis& diagnosis);

/// Both sides, each with the same set of causes.
struct Sides {
  const Diagnosis &real, &simulated;
  std::vector<std::string> not_shown;  ///< causes that one of the logs cannot show
};

Judged judged_difference(const Sides& sides, const std::vector<ComparedCause>& causes);

}  // namespace ident
