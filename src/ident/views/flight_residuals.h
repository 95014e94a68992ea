// What a fit to flight left over of every channel: over time, its distribution, colour and spectrum.
#pragma once

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

/// Residuals of the fit in units of the noise found. The table counts all logs, the pictures show the first;
/// channels of one sensor share their pictures.
Section flight_residuals(const FlightRecord& record, const FlightFit& fit);

/// The accelerations that the fit took for gusts and other work from outside, with the band of 3 standard
/// deviations of the process noise.
Section outside_accelerations(const FlightRecord& record, const FlightFit& fit);

}  // namespace ident
