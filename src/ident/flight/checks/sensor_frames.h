// Do the sensors of a log agree with each other and with gravity? Each contradiction names its axis.
//
//   integral of w over a window    = turn of the attitude, body axes                                    (1)
//   integral of R_WB f + g         = change of velocity, world axes                                     (2)
//   integral of v                  = change of position                                                 (3)
//   mean of f                      = R_WB^T (change of velocity / window - g), body axes                (4)
//
// The median of f itself points up, -g along z: a multirotor carries its weight by thrust along -z.
#pragma once

#include "ident/flight/checks/log_self_test.h"

namespace ident {

SensorFrames test_sensor_frames(const FlightRecord& record, double gravity);

}  // namespace ident
