// Detects motors of first order, of which only the lag 2 zeta_m/omega_m is known.
#pragma once

#include <optional>

#include "ident/flight/fit/fit.h"
#include "ident/result/parameter.h"

namespace ident {

/// 2 zeta_m / omega_m, s, with its standard deviation.
struct MotorLag {
  double seconds = 0.0, std = 0.0;
};

/// The lag, where a fit knows only the ratio of omega_m and zeta_m: neither had a prior, neither is
/// identifiable, and zeta_m is large. Empty otherwise.
std::optional<MotorLag> first_order_lag(const Vehicle& vehicle, const Theta& theta, const FlightFit& fit,
                                        const std::vector<Parameter>& parameters);

/// The vehicle with zeta_m held near 50, where the second pole is ten thousand times as fast as the first,
/// and with the omega_m that gives this lag as a start.
Vehicle with_first_order_motors(Vehicle vehicle, const MotorLag& lag);

}  // namespace ident
