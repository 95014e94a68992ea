// Error of measured rotor speeds as the input, expressed as accelerations that were not commanded.
#pragma once

#include <Eigen/Core>

#include "ident/flight/record/flight_record.h"

namespace ident {

/// Variance of the angular acceleration about the body axes, (rad/s^2)^2, then of the acceleration,
/// (m/s^2)^2.
using AccelerationVariance = Eigen::Matrix<double, 6, 1>;

/// Variance of the mean acceleration over the rows [begin, end] of an arc due to the error of its rotor
/// speeds, with the constants of the record; the acceleration is along `axes`. Zero where commands are the
/// input.
///
/// The error of a smoothed random walk has the spectrum R/(1 + (w/w_c)^4), with R the density of the sensor
/// noise: its mean over h seconds has the variance R/h, at most that of the error itself. Added to it is the
/// squared difference to another smoothing, because where motors are driven suddenly the error is not random.
AccelerationVariance input_error(const FlightRecord& record, const FlightArc& arc, std::size_t begin,
                                 std::size_t end, GustAxes axes);

/// The same for the accelerations themselves: their mean variance over the record, and their correlation
/// time, s.
struct InputErrorProcess {
  AccelerationVariance variance = AccelerationVariance::Zero();
  double time = 0.0;
};
InputErrorProcess input_error_process(const FlightRecord& record, GustAxes axes);

}  // namespace ident
