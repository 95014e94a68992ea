// Filters, noise, delays and sampling of each channel.
#include "sensors.h"

#include <cmath>
#include <numbers>

namespace field {
namespace {

int steps(double seconds, double hz) { return static_cast<int>(std::lround(seconds * hz)); }

LowPass filter(int order, double hz, double rate) {
  return order == 0 ? LowPass::none() : LowPass(order, hz, rate);
}

Vector3d noise(Random& random, double sigma) {
  return sigma * Vector3d(random.normal(), random.normal(), random.normal());
}

double filtered_sigma(double raw, int order, double hz, double rate) {
  return order == 0 ? raw : raw * std::sqrt(noise_bandwidth(order, hz) / (0.5 * rate));
}

}  // namespace

double Instruments::gyro_sigma() const { return filtered_sigma(gyro_noise, gyro_order, gyro_hz, physics_hz); }
double Instruments::accel_sigma() const {
  return filtered_sigma(accel_noise, accel_order, accel_hz, physics_hz);
}
double Instruments::gyro_delay() const {
  return imu_delay + (gyro_order == 0 ? 0 : group_delay(gyro_order, gyro_hz));
}

Instruments draw_instruments(Random& random, const Vehicle& v, bool plain) {
  Instruments in;
  in.log_hz = random.pick({100.0, 125.0, 200.0, 250.0, 250.0, 400.0, 500.0});
  const double command_hz = random.pick({10.0, 20.0, 25.0, 50.0, 50.0, 100.0, 100.0});
  in.command_every = std::max(1, static_cast<int>(std::ceil(in.log_hz / command_hz - 1e-9)));
  in.rotor_speeds = random.chance(0.4);
  in.speed_every = random.chance(0.5) ? 1 : std::max(1, static_cast<int>(in.log_hz / 50));
  in.speed_noise = random.log_uniform(0.0005, 0.005);
  in.speed_delay = random.pick({0.0, 0.001, 0.003, 0.006});
  in.voltage = random.chance(0.8);
  in.euler = random.chance(0.2);
  in.pulses = random.chance(0.3);
  in.empty_cells = random.chance(0.35);
  in.gyro_order = random.pick({0, 1, 2, 2, 2, 4});
  in.accel_order = random.pick({0, 1, 2, 2, 2, 4});
  in.gyro_hz = random.log_uniform(plain ? 60 : 25, 150);
  in.accel_hz = random.log_uniform(plain ? 40 : 12, 100);
  in.imu_delay = random.pick({0.0, 0.0, 0.001, 0.002}) + (plain ? 0 : random.pick({0.0, 0.0, 0.003}));
  in.gyro_noise = random.log_uniform(6e-3, 4e-2);
  in.accel_noise = random.log_uniform(0.08, 0.5);
  in.estimator = random.chance(v.m < 0.1 ? 0.4 : 0.6);
  const double outside_hz =
      in.estimator ? random.pick({50.0, 100.0, 100.0}) : random.pick({100.0, 200.0, 250.0});
  in.attitude_every = std::max(1, static_cast<int>(std::lround(in.log_hz / outside_hz)));
  in.position_every = in.estimator ? 2 * in.attitude_every : in.attitude_every;
  in.attitude_noise = in.estimator ? random.log_uniform(2e-4, 1e-3) : random.log_uniform(8e-4, 4e-3);
  in.attitude_drift = in.estimator ? random.uniform(0.002, 0.012) : 0;
  in.drift_time = random.uniform(3, 12);
  in.velocity_noise = in.estimator ? random.log_uniform(5e-3, 2e-2) : random.log_uniform(5e-3, 3e-2);
  in.velocity_drift = in.estimator ? random.uniform(0.02, 0.1) : 0;
  in.position_noise = in.estimator ? random.log_uniform(0.005, 0.03) : random.log_uniform(5e-4, 3e-3);
  in.outside_delay = plain ? 0 : random.pick({0.0, 0.0, 0.0, 0.004, 0.01});
  return in;
}

Sensors::Sensors(const Vehicle& v, const Effects& e, const Instruments& in, Random random)
    : v_(v),
      e_(e),
      in_(in),
      random_(random),
      gyro_filter_(filter(in.gyro_order, in.gyro_hz, in.physics_hz)),
      accel_filter_(filter(in.accel_order, in.accel_hz, in.physics_hz)),
      gyro_delay_(steps(in.imu_delay, in.physics_hz)),
      accel_delay_(steps(in.imu_delay, in.physics_hz)),
      outside_delay_(steps(in.outside_delay, in.physics_hz)),
      speed_delay_(steps(in.speed_delay, in.physics_hz)) {
  const double angle = e.imu_turn.norm();
  const Vector3d axis = angle > 0 ? Vector3d(e.imu_turn / angle) : Vector3d(Vector3d::UnitX());
  imu_from_body_ = Eigen::AngleAxisd(-angle, axis).toRotationMatrix();
  gyro_bias_ = noise(random_, 0.004);
  phase_ = PerRotor::Zero(v.rotors());
  for (int i = 0; i < v.rotors(); ++i) shake_.push_back(noise(random_, 0.6));
  attitude_drift_ = noise(random_, in.attitude_drift);
  velocity_drift_ = noise(random_, in.velocity_drift);
  position_drift_ = in.drift_time * velocity_drift_;
  command_phase_ = random_.integer(0, in.command_every - 1);
}

void Sensors::imu(const Truth& truth) {
  const Vector3d& w = truth.motion.w_B;
  const Vector3d arm = e_.imu_r_B - e_.c_B;
  Vector3d f = truth.a.f_B + truth.a.dw_B.cross(arm) + w.cross(w.cross(arm));
  Vector3d gyro = w;
  if (e_.vibration > 0) {  // every rotor is a little out of balance: force with the square of its speed
    phase_ += truth.Omega / in_.physics_hz;
    for (int i = 0; i < v_.rotors(); ++i) {
      const double speed = truth.Omega[i] / v_.hover_speed();
      const double size = e_.vibration * speed * speed / v_.rotors();
      const Vector3d& s = shake_[static_cast<size_t>(i)];
      f += size * s * std::sin(phase_[i]);
      gyro += 0.02 * size * Vector3d(s.y(), s.z(), s.x()) * std::cos(phase_[i]);
    }
  }
  raw_gyro_ = imu_from_body_ * gyro + gyro_bias_ + noise(random_, in_.gyro_noise);
  const Vector3d accel = imu_from_body_ * f + e_.imu_bias + noise(random_, in_.accel_noise);
  gyro_ = gyro_delay_(gyro_filter_.active() ? gyro_filter_(raw_gyro_) : raw_gyro_);
  accel_ = accel_delay_(accel_filter_.active() ? accel_filter_(accel) : accel);
}

void Sensors::drift() {
  const double decay = std::exp(-1 / (in_.physics_hz * in_.drift_time)), fresh = std::sqrt(1 - decay * decay);
  attitude_drift_ = decay * attitude_drift_ + fresh * noise(random_, in_.attitude_drift);
  velocity_drift_ = decay * velocity_drift_ + fresh * noise(random_, in_.velocity_drift);
  // The path drifts with the velocity, and a fix draws it back.
  position_drift_ += (velocity_drift_ - position_drift_ / in_.drift_time) / in_.physics_hz;
}

void Sensors::step(const Truth& truth) {
  imu(truth);
  if (in_.estimator) drift();
  const Motion& m = truth.motion;  // of the centre of gravity; sensors sit at the origin
  outside_ = outside_delay_({m.p_W - m.q_WB * e_.c_B, m.v_W - m.q_WB * m.w_B.cross(e_.c_B), m.q_WB});
  Omega_ = speed_delay_(truth.Omega);
  voltage_ += (truth.voltage - voltage_) * (voltage_ == 0 ? 1 : 1 / (0.05 * in_.physics_hz));
}

Row Sensors::row(double t, long number, const PerRotor& command) {
  Row row = held_;
  const auto due = [&](int every, int phase) { return number == 0 || (number + phase) % every == 0; };
  row.t = t;
  row.gyro = gyro_;
  row.accel = accel_;
  row.has_command = due(in_.command_every, command_phase_);
  row.has_attitude = due(in_.attitude_every, 0);
  row.has_position = due(in_.position_every, 0);
  row.has_speeds = due(in_.speed_every, 0);
  if (row.has_command) row.command = command;
  if (row.has_attitude) {
    const Vector3d turn = attitude_drift_ + noise(random_, in_.attitude_noise);
    row.q_WB =
        outside_.q_WB * Eigen::Quaterniond(1, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized();
  }
  if (row.has_position) {
    row.p_W = outside_.p_W + position_drift_ + noise(random_, in_.position_noise);
    row.v_W = outside_.v_W + velocity_drift_ + noise(random_, in_.velocity_noise);
  }
  if (row.has_speeds) {
    row.Omega = Omega_;
    for (double& Omega : row.Omega) Omega *= 1 + in_.speed_noise * random_.normal();
  }
  row.voltage = voltage_ + 0.003 * v_.battery.cells * random_.normal();
  held_ = row;
  return row;
}

}  // namespace field
