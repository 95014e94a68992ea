// Whether more pushes the vehicle than gusts of the stated air do.
#pragma once

#include <nlohmann/json.hpp>

#include "ident/flight/checks/gusts_expected.h"
#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// What pushes from outside, beside what gusts of the stated air do.
struct AirBalance {
  GustsExpected expected;
  /// Standard deviation of the force from outside about its mean in each log, three axes together, N. A
  /// steady wind has no part in it.
  double force = 0.0;

  double most() const;  ///< force above which it is no such air, N
  bool exceeds() const { return force > most(); }
};
/// Nothing where the log shows no forces.
std::optional<AirBalance> air_balance(const FlightRecord& record, const FlightFit& fit);

nlohmann::ordered_json as_json(const AirBalance& air);

/// Warns (`air_exceeds`) of an error of the model that was taken for gusts.
void warn_of_excess(Result& result, const std::optional<AirBalance>& air);

}  // namespace ident
