// Which constants and effects differ between two fits of one model: two tests, without any flight.
//
// With value z, covariance C and response W of either fit, and delta a change of the truth between the two:
//
//   d = z_real - z_sim ,   S = C_real + C_sim                                  (1)
//   cause named by a side, constants k free of priors:  d_k' S_kk^-1 d_k ~ chi^2                    (2)
//   constant under its prior:  d = (W_real + W_sim)/2 e_k delta + noise of S                        (3)
//
// The prior is the same for both sides, so that S counts it twice: intervals are wide, never narrow. By (3)
// what only a product determines (kT km^2) differs by either of its factors, which are told as alternatives.
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
  double difference = kNaN, std = kNaN;  ///< by (1); by (3) for a constant under its prior
};

/// An effect, or a constant as `parameter:NAME`.
struct ComparedCause {
  std::string name;
  std::vector<ComparedConstant> constants;
  double p = 1.0;                         ///< that chance makes such a difference
  bool differs = false;                   ///< beyond chance over all looks
  std::vector<std::string> alternatives;  ///< constants that explain the same difference about as well
};

/// `named`: causes that a side names with a material share; the others are fitted, and never differ.
std::vector<ComparedCause> differences(const ComparedFit& real, const ComparedFit& simulated,
                                       const std::set<std::string>& named);

}  // namespace ident
