// Motors that follow their commands as systems of first order do.
#pragma once

#include <optional>

#include "ident/flight/fit/fit.h"

namespace ident {

/// 2 zeta_m / omega_m, s, with its standard deviation.
struct MotorLag {
  double seconds = 0.0, std = 0.0;
};

/// The lag of motors of which nothing else can be told: a fit that knows the ratio of omega_m and zeta_m, of
/// which neither was known beforehand nor counts as known among its `parameters`, with a large zeta_m. Empty
/// otherwise.
std::optional<MotorLag> first_order_lag(const Vehicle& vehicle, const Theta& theta, const FlightFit& fit,
                                        const std::vector<Parameter>& parameters);

/// The vehicle with zeta_m held near 50, where the second pole is ten thousand times as fast as the first,
/// and the omega_m that makes this lag, to start from.
Vehicle with_first_order_motors(Vehicle vehicle, const MotorLag& lag);

}  // namespace ident
