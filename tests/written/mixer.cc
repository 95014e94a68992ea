// PX4: control_allocator and FunctionMotors; ArduPilot: AP_MotorsMatrix; Betaflight: mixer.c; Crazyflie:
// power_distribution.
#include "mixer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace written {
namespace {

double clamp01(double x) { return std::clamp(x, 0.0, 1.0); }

// ControlAllocator publishes actuator_motors = mix [torque; thrust]; the thrust model is applied after that
// topic, where the output driver reads it (FunctionMotors::updateValues).
Outputs mix_px4(const Vehicle& v, const Inputs& u) {
  const Eigen::Vector4d control = px4_mix(v) * u;
  Outputs out;
  for (int i = 0; i < 4; ++i) {
    const auto n = static_cast<size_t>(i);
    const double c = static_cast<double>(static_cast<float>(clamp01(control[i])));
    const double a = v.thrust_model, b = 1 - a;
    out.stored[n] = c;
    out.delta[n] = a > 0 ? -b / (2 * a) + std::sqrt(b * b / (4 * a * a) + c / a) : c;
  }
  return out;
}

double pulse(double actuator) { return std::round(kPwmMin + (kPwmMax - kPwmMin) * clamp01(actuator)); }

// AP_MotorsMatrix for frame X: roll, pitch and yaw factors of 0.5; the thrust curve; the range between spin
// min and max.
Outputs mix_ardupilot(const Inputs& u) {
  constexpr double roll[] = {-0.5, 0.5, 0.5, -0.5}, pitch[] = {0.5, -0.5, 0.5, -0.5},
                   yaw[] = {0.5, 0.5, -0.5, -0.5};
  Outputs out;
  for (size_t n = 0; n < 4; ++n) {
    const double thrust = clamp01(u[3] + roll[n] * u[0] + pitch[n] * u[1] + yaw[n] * u[2]);
    const double e = kThrustExpo;
    const double ratio = ((e - 1) + std::sqrt((1 - e) * (1 - e) + 4 * e * thrust)) / (2 * e);
    out.stored[n] = pulse(kSpinMin + (kSpinMax - kSpinMin) * clamp01(ratio));
    out.delta[n] = (out.stored[n] - kPwmMin) / (kPwmMax - kPwmMin);
  }
  return out;
}

// mixerQuadX with yaw_motors_reversed off: the yaw term enters with the opposite sign.
Outputs mix_betaflight(const Inputs& u) {
  constexpr double roll[] = {-1, -1, 1, 1}, pitch[] = {1, -1, 1, -1}, yaw[] = {-1, 1, 1, -1};
  Outputs out;
  for (size_t n = 0; n < 4; ++n) {
    const double part = clamp01(u[3] + roll[n] * u[0] + pitch[n] * u[1] - yaw[n] * u[2]);
    out.stored[n] = std::round(kMotorLow + (kMotorHigh - kMotorLow) * part);
    out.delta[n] = (out.stored[n] - kMotorLow) / (kMotorHigh - kMotorLow);
  }
  return out;
}

// power_distribution_quadrotor.c, legacy mode: r and p are half of roll and pitch; yaw positive to the left.
Outputs mix_crazyflie(const Inputs& u) {
  constexpr double roll[] = {-0.5, -0.5, 0.5, 0.5}, pitch[] = {-0.5, 0.5, 0.5, -0.5}, yaw[] = {-1, 1, -1, 1};
  Outputs out;
  for (size_t n = 0; n < 4; ++n) {
    out.stored[n] = std::round(65535 * clamp01(u[3] + roll[n] * u[0] + pitch[n] * u[1] + yaw[n] * u[2]));
    out.delta[n] = out.stored[n] / 65535;
  }
  return out;
}

}  // namespace

Eigen::Matrix4d px4_mix(const Vehicle& v) {
  constexpr double CT = 6.5, KM = 0.05;
  Eigen::Matrix4d effect;
  for (int i = 0; i < 4; ++i) {
    const Rotor& rotor = v.rotors[static_cast<size_t>(i)];
    const Vector3d a(0, 0, -1);
    effect.col(i) << CT * rotor.r_B.cross(a) - CT * KM * rotor.s * a, CT * a.z();
  }
  Eigen::Matrix4d mix = effect.completeOrthogonalDecomposition().pseudoInverse();
  const double roll = std::sqrt(mix.col(0).squaredNorm() / 2),
               pitch = std::sqrt(mix.col(1).squaredNorm() / 2);
  mix.leftCols<2>() /= std::max(roll, pitch);
  mix.col(2) /= mix.col(2).maxCoeff();
  mix.col(3) /= -mix.col(3).cwiseAbs().mean();  // our input is the thrust upwards, -thrust_setpoint.z
  return mix;
}

Vector3d firmware_signs(Stack stack) {
  // Betaflight and Crazyflie: positive pitch is nose down, positive yaw is to the left.
  return stack == Stack::betaflight || stack == Stack::crazyflie ? Vector3d(1, -1, -1) : Vector3d(1, 1, 1);
}

Outputs mix(const Vehicle& v, const Inputs& u) {
  switch (v.stack) {
    case Stack::px4:
      return mix_px4(v, u);
    case Stack::ardupilot:
      return mix_ardupilot(u);
    case Stack::betaflight:
      return mix_betaflight(u);
    default:
      return mix_crazyflie(u);
  }
}

Outputs stopped(const Vehicle& v) {
  Outputs out;
  if (v.stack == Stack::px4) out.stored.fill(std::numeric_limits<double>::quiet_NaN());
  if (v.stack == Stack::ardupilot) out.stored.fill(kPwmMin);
  if (v.stack == Stack::betaflight) out.stored.fill(kMotorLow);
  return out;
}

Outputs idling(const Vehicle& v) {
  if (v.stack != Stack::ardupilot) return mix(v, Inputs::Zero());
  Outputs out;
  out.stored.fill(pulse(kSpinArm));
  out.delta.fill((out.stored[0] - kPwmMin) / (kPwmMax - kPwmMin));
  return out;
}

}  // namespace written
