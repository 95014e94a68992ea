// What gusts of the stated air do to a vehicle that hovers: the prior of the process noise.
//
//   v_dot_i = change of the acceleration by a gust of one standard deviation along axis i   (26)
//   M_roll  = m v_dot_z b(y) ,  b(y) = (y/2) sqrt(2 (1 - exp(-2 y/L)))   (27)
//
// (26) takes the drag that the vehicle file states. Where it states none, a usual one: 0.3 1/s across the
// rotors and 0.5 1/s along them, per mass. (27): the two halves of the rotors, y from the centre, feel
// gusts that differ over 2 y as an exponential correlation of length L makes them; pitch and yaw likewise.
#pragma once

#include "ident/flight/record/flight_record.h"

namespace ident {

struct GustsExpected {
  AirLevel level = kUnstatedAir;
  bool stated = false;  ///< by the vehicle or campaign file
  AirPrior prior;
  double force = 0.0;  ///< root of the summed squares of three axes, N
};

GustsExpected gusts_expected(const FlightRecord& record);

}  // namespace ident
