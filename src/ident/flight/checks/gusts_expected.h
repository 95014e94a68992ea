// What gusts of the stated air do to a vehicle that hovers.
//
//   F = m sqrt(v_dot_x^2 + v_dot_y^2 + v_dot_z^2)   (31)
//
// v_dot_i is the change of the acceleration by a gust of one standard deviation along axis i. It follows from
// the drag that the vehicle file states. Where it states none along an axis, a usual one takes its place:
// 0.3 1/s across the rotors and 0.5 1/s along them, per mass.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

struct GustsExpected {
  AirLevel level = kUnstatedAir;
  bool stated = false;   ///< by the vehicle or campaign file
  double force = 0.0;    ///< standard deviation, three axes together, N
  double log_std = 0.0;  ///< standard deviation of log(force)
};

GustsExpected gusts_expected(const FlightRecord& record);

}  // namespace ident
