// From normalised roll, pitch, yaw and thrust to motor commands, as each autopilot's firmware does it.
#pragma once

#include <Eigen/Core>

#include "vehicle.h"

namespace written {

using Inputs = Eigen::Vector4d;  // roll, pitch, yaw, thrust: normalised, in the firmware's own signs

struct Outputs {
  PerRotor stored{};  // as the firmware logs it: control, PWM us, DShot step, 0..65535
  PerRotor delta{};   // the normalised command of the ESC, 0 to 1
};

constexpr double kPwmMin = 1000, kPwmMax = 2000;  // us, ArduPilot
constexpr double kSpinArm = 0.10, kSpinMin = 0.15, kSpinMax = 0.95, kThrustExpo = 0.65;
constexpr double kMotorLow = 158, kMotorHigh = 2047;  // Betaflight's motorOutput for DShot

// PX4's allocation matrix from CA_ROTORn_* as the firmware normalises it; columns roll, pitch, yaw, thrust
// (upwards).
Eigen::Matrix4d px4_mix(const Vehicle& v);

Outputs mix(const Vehicle& v, const Inputs& u);
Outputs stopped(const Vehicle& v);  // disarmed
Outputs idling(const Vehicle& v);   // armed on the ground

// The signs that turn FRD torque into the firmware's roll, pitch and yaw.
Vector3d firmware_signs(Stack stack);

}  // namespace written
