// Which constants and effects differ between two fits of one model: statistics only, without any flight.
//
// With value z, covariance C and response W of either fit, and delta_k a change of the truth between the two:
//
//   d = z_real - z_sim ,   S = C_real + C_sim                                  (1)
//   d = sum_k (W_real + W_sim)/2 e_k delta_k + noise of S                      (2)
//
// Causes are taken up one after the other, by what they explain of d' S^-1 d beside those before. The prior
// is the same for both sides, so that S counts it twice: intervals are wide, never narrow. By (2) a mass that
// was stated too well to move shows in all constants that take its place, and what only a product determines
// (kT km^2) differs by either of its factors, which are told as alternatives.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ident/core/math.h"
#include "ident/gap/comparison/compared_fit.h"

namespace ident {

struct ComparedConstant {
  std::string name;
  double real = kNaN, real_std = kNaN, simulated = kNaN, simulated_std = kNaN;
  double difference = kNaN, std = kNaN;  ///< by (1); by (2) of a constant under its prior that differs
};

/// An effect, or a constant as `parameter:NAME`.
struct ComparedCause {
  std::string name;
  std::vector<ComparedConstant> constants;
  double p = 1.0;                         ///< that chance makes such a difference, by (1)
  bool differs = false;                   ///< beyond chance over all looks
  std::vector<std::string> alternatives;  ///< constants that explain the same difference about as well
};

struct ComparisonRules {
  /// Effects that a side names with a material share of its gap. Others are fitted, and never differ.
  std::set<std::string> material;
  /// Whether constants may differ that no side names. Not where something unknown acts in a log: constants
  /// take its place.
  bool constants = true;
};

std::vector<ComparedCause> differences(const ComparedFit& real, const ComparedFit& simulated,
                                       const ComparisonRules& rules);

}  // namespace ident
