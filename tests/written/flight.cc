// Steps the vehicle, its sensors and its autopilot.
#include "flight.h"

#include "filters.h"
#include "random.h"

namespace written {
namespace {

constexpr double kRate = 1 / kStep;

// The filters that this firmware applies before it uses and logs gyro and accelerometer.
class Front {
 public:
  explicit Front(const Vehicle& v)
      : stages_(v.stack == Stack::betaflight),
        biquad_(v.accel_biquad),
        gyro_(std::min(v.gyro_hz, kRate / 4), kRate),
        accel_(v.accel_hz, kRate),
        gyro_1_(1, 250, kRate),
        gyro_2_(1, 500, kRate),
        accel_2_(2, v.accel_hz, kRate) {
    const Vector3d rest(0, 0, -kGravity);
    accel_.reset(rest), accel_2_.reset(rest);
  }
  Vector3d gyro(const Vector3d& x) { return stages_ ? gyro_2_(gyro_1_(x)) : gyro_(x); }
  Vector3d accel(const Vector3d& x) { return biquad_ ? accel_(x) : accel_2_(x); }

 private:
  bool stages_, biquad_;
  Butterworth gyro_, accel_;
  Stages gyro_1_, gyro_2_, accel_2_;
};

Vector3d noise(Random& random, double size) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return size * Vector3d(x, y, z);
}

}  // namespace

Flight fly(const Vehicle& v, std::uint64_t seed) {
  Flight flight;
  flight.v = v;
  flight.full_voltage = v.stack == Stack::crazyflie ? 4.1 : v.stack == Stack::betaflight ? 16.4 : 16.0;
  const Noise size;
  Random random(seed ^ 0xf117u);
  const Vector3d bias = noise(random, size.gyro_bias);
  const double vigour = v.stack == Stack::crazyflie || v.stack == Stack::betaflight ? 2.0 : 1.0;
  const Plan plan(seed, vigour);
  Autopilot autopilot(v);
  Front front(v);
  State x;
  Outputs motors = stopped(v);
  SetPoints set;
  bool landed = false;
  for (long k = 0;; ++k) {
    const double t = static_cast<double>(k) * kStep;
    if (flight.take_off == 0 && !x.on_ground) flight.take_off = t;
    if (t > kDescend && x.on_ground && !landed) landed = true, flight.landing = t;
    const bool armed = t >= kArm && !(landed && t > flight.landing + 1.5);
    if (landed && t > flight.landing + 3) break;

    Sample s;
    s.truth = x;
    s.gyro = x.w_B + bias + noise(random, size.gyro);
    s.accel = specific_force(v, x) + noise(random, size.accel);
    s.gyro_filtered = front.gyro(s.gyro);
    s.accel_filtered = front.accel(s.accel);
    const Vector3d turn = noise(random, size.angle / 2);
    s.q_WB = (x.q_WB * Eigen::Quaterniond(1, turn.x(), turn.y(), turn.z())).normalized();
    s.v_W = x.v_W + noise(random, size.velocity);
    s.p_W = x.p_W + noise(random, size.position);
    if (k % v.control_steps == 0) {
      if (!armed) {
        motors = stopped(v), set = SetPoints{};
      } else if (landed &&
                 t < flight.landing + kMaybeLanded) {  // the thrust fades while contact is being noticed
        set = SetPoints{};
        set.inputs[3] = t < flight.landing + kContact ? 0.2 : 0.05;
        motors = mix(v, set.inputs);
      } else if (t < kTakeOff || landed) {
        motors = idling(v), set = SetPoints{};
      } else {
        // The loops see the state without the estimator's white noise, which no firmware would feed them.
        set = autopilot.run({x.p_W, x.v_W, s.gyro_filtered - bias, x.q_WB}, plan.at(t),
                            v.control_steps * kStep);
        motors = mix(v, set.inputs);
      }
    }
    s.set = set, s.motors = motors, s.armed = armed;
    flight.samples.push_back(s);
    x = advance(v, x, motors.delta);
  }
  return flight;
}

}  // namespace written
