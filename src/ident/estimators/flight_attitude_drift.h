// Whether the attitude of a log comes from an estimator that drifts.
#pragma once

#include <array>

#include "ident/estimators/flight_record.h"

namespace ident {

/// Slow error of the attitude shown, about each axis of the body, to start from, rad: where it strays from
/// the integral of the rates by more than white noise of both makes it; all zero where it does not, or there
/// are no rates. Without a model of the vehicle: what moves with the rates and angles (mounting, scale,
/// delay) is taken out by regression, and so is a constant bias.
std::array<ColouredNoise, 3> attitude_drift(const FlightRecord& record);

}  // namespace ident
