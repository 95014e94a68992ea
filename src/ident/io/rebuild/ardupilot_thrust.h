// ArduPilot's way from the demands of its rate controller to the pulses of its motors.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "ident/data/log_streams.h"

namespace ident {

/// Shares of roll, pitch, yaw and throttle in the thrust of each motor, [motor](4), up to a factor for each
/// column (AP_MotorsMatrix::add_motor; yaw is positive for rotors that turn counter-clockwise). Empty for
/// frames that are in no table here.
std::optional<Eigen::MatrixXd> ardupilot_mix(const LogStreams& log);

/// Thrust, 0 to 1, to command, 0 to 1 over the range of pulses, and back (Thrust_Linearization).
struct ArdupilotCurve {
  double expo, spin_min, spin_max;

  /// `lift`: LiftMax of MOTB; `volts`: its BatVolt, voltage over the highest; 1 without compensation.
  double command(double thrust, double lift, double volts) const;
  double thrust(double command, double lift, double volts) const;
};

/// By MOT_THST_EXPO, MOT_SPIN_MIN and MOT_SPIN_MAX. Empty before 3.4, which had others.
std::optional<ArdupilotCurve> ardupilot_curve(const LogStreams& log);

}  // namespace ident
