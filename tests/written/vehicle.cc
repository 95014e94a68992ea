// Typical constants of four vehicles, and the place and spin of each motor number.
#include "vehicle.h"

#include "random.h"

namespace written {
namespace {

constexpr double kCcw = 1, kCw = -1;

Rotor rotor(double x, double y, double s) { return {Vector3d(x, y, 0), s}; }

// 1 front right, 2 rear left, 3 front left, 4 rear right; 1 and 2 counter-clockwise. PX4 quad x and ArduPilot
// X.
std::array<Rotor, 4> order_px4(double a) {
  return {rotor(a, a, kCcw), rotor(-a, -a, kCcw), rotor(a, -a, kCw), rotor(-a, a, kCw)};
}

// 1 rear right, 2 front right, 3 rear left, 4 front left; 2 and 3 counter-clockwise. Betaflight, props in.
std::array<Rotor, 4> order_betaflight(double a) {
  return {rotor(-a, a, kCw), rotor(a, a, kCcw), rotor(-a, -a, kCcw), rotor(a, -a, kCw)};
}

// 1 front right, 2 rear right, 3 rear left, 4 front left; 1 and 3 counter-clockwise.
std::array<Rotor, 4> order_crazyflie(double a) {
  return {rotor(a, a, kCcw), rotor(-a, a, kCw), rotor(-a, -a, kCcw), rotor(a, -a, kCw)};
}

Vehicle typical(Stack stack) {
  Vehicle v{};
  v.stack = stack;
  switch (stack) {
    case Stack::px4:
      v.m = 1.2, v.J = {0.0125, 0.0135, 0.0230}, v.kT = 9.8e-6, v.kQ = 1.55e-7, v.km = 1050, v.omega_m = 45;
      v.zeta_m = 0.95, v.Jp = 4.5e-5, v.rotors = order_px4(0.16), v.control_steps = 10, v.gyro_hz = 40,
      v.accel_hz = 30;
      break;
    case Stack::ardupilot:
      v.m = 1.5, v.J = {0.0190, 0.0210, 0.0350}, v.kT = 1.25e-5, v.kQ = 2.0e-7, v.km = 1080, v.omega_m = 40;
      v.zeta_m = 1.0, v.Jp = 6e-5, v.rotors = order_px4(0.18), v.control_steps = 10, v.gyro_hz = 20,
      v.accel_hz = 20;
      break;
    case Stack::betaflight:
      v.m = 0.6, v.J = {0.0019, 0.0023, 0.0035}, v.kT = 1.6e-6, v.kQ = 2.1e-8, v.km = 3100, v.omega_m = 80;
      v.zeta_m = 1.0, v.Jp = 6e-6, v.rotors = order_betaflight(0.078), v.control_steps = 1, v.gyro_hz = 250,
      v.accel_hz = 25;
      break;
    case Stack::crazyflie:
      v.m = 0.030, v.J = {1.66e-5, 1.68e-5, 2.93e-5}, v.kT = 2.9e-8, v.kQ = 1.75e-10, v.km = 2600,
      v.omega_m = 60;
      v.zeta_m = 1.05, v.Jp = 3.5e-8, v.rotors = order_crazyflie(0.0325), v.control_steps = 8, v.gyro_hz = 80,
      v.accel_hz = 30;
      break;
  }
  return v;
}

}  // namespace

Vehicle make_vehicle(Stack stack, const std::string& name, std::uint64_t seed) {
  Vehicle v = typical(stack);
  v.name = name;
  Random random(seed);
  for (double* constant :
       {&v.m, &v.J[0], &v.J[1], &v.J[2], &v.kT, &v.kQ, &v.km, &v.omega_m, &v.zeta_m, &v.Jp})
    *constant *= random.uniform(0.95, 1.05);
  return v;
}

}  // namespace written
