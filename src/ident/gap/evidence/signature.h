// The signature of a named cause against the flight: what it predicts in a channel over what the model lacks
// there.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/search/search_result.h"
#include "ident/result/result.h"

namespace ident {

/// One point a chunk of flight. A cause with one parameter has x per unit of it, so that the points' slope is
/// the parameter; with several x is what the cause predicts at the size found, and the slope is 1.
struct Signature {
  std::string cause, channel;
  std::string parameter, parameter_unit;  ///< empty with several parameters
  std::vector<double> x, y;
  double found = 1.0, found_std = kNaN;  ///< slope by the diagnosis
  double slope = kNaN,
         slope_std = kNaN;  ///< least squares through the origin, and as scattered as the points
  double correlation = kNaN;
  double noise = 0.0;  ///< standard deviation of a point for a perfect model
};

/// Signatures of each cause of the best model, in the force, moment and rotor where it shows most. y is what
/// the measurements lack of the model found when this cause alone is taken out of it, along the states of the
/// base model.
std::vector<Signature> signatures(const FlightRecord& record, const SearchResult& search);

}  // namespace ident
