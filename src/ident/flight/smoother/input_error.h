// What is left of the noise of measured rotor speeds, as accelerations that nobody commanded.
#pragma once

#include <Eigen/Core>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Of the angular acceleration about the body's axes, (rad/s^2)^2, then of the acceleration, (m/s^2)^2.
using AccelerationVariance = Eigen::Matrix<double, 6, 1>;

/// Variance of the mean acceleration over the rows [begin, end] of an arc by the error of its speeds, with
/// the record's constants; the acceleration along `axes`. Zero where commands are the input.
///
/// The error of a smoothed random walk has the spectrum R/(1 + (w/w_c)^4) with R the density of the noise, so
/// that a mean over h seconds varies by R/h, and never by more than the error itself. To that comes what
/// another smoothing would say: where motors are suddenly driven, an error is none by chance.
AccelerationVariance input_error(const FlightRecord& record, const FlightArc& arc, std::size_t begin,
                                 std::size_t end, GustAxes axes);

/// The same for the accelerations themselves, in the mean of the record, and how long they last, s.
struct InputErrorProcess {
  AccelerationVariance variance = AccelerationVariance::Zero();
  double time = 0.0;
};
InputErrorProcess input_error_process(const FlightRecord& record, GustAxes axes);

}  // namespace ident
