// Rows of a log: truth, noise, and NaN where a group is not sampled.
#include "ident/sim/recorder.h"

namespace ident {

Recorder::Recorder(const Plant& plant, const SensorNoise& noise, const LoggedSignals& signals,
                   double hover_speed, Random& random)
    : plant_(&plant), noise_(noise), signals_(signals), hover_speed_(hover_speed), random_(&random) {
  for (int i = 0; i < 3; ++i) gyro_bias_[i] = noise_.gyro_bias * random_->normal();
  const std::size_t rotors = plant.vehicle().rotors.size();
  if (signals_.commands) log_.delta.resize(rotors);
  if (signals_.rotor_speeds > 0) log_.Omega.resize(rotors);
}

void Recorder::look() { seen_motion_.push_back({plant_->imu().gyro, plant_->state().body.q_WB}); }

// A draw is made also where nothing is sampled, so that the rates of one group leave the noise of the others.
double Recorder::seen(int every, double truth, double std) {
  const double noisy = truth + std * random_->normal();
  return log_.t.size() % static_cast<std::size_t>(every) == 0 ? noisy : kNaN;
}

void Recorder::add(const Vec3<double>& truth, int every, double std,
                   std::array<std::vector<double>, 3>& columns) {
  if (every <= 0) return;
  for (std::size_t k = 0; k < 3; ++k) columns[k].push_back(seen(every, truth[static_cast<int>(k)], std));
}

void Recorder::add_attitude(const Vec4<double>& q_WB) {
  if (signals_.attitude <= 0) return;
  Vec3<double> turn;
  for (int k = 0; k < 3; ++k) turn[k] = noise_.attitude * random_->normal();
  const Vec4<double> q = quaternion_product(q_WB, Vec4<double>(quaternion_from_rotation_vector(turn)));
  const bool sampled = log_.t.size() % static_cast<std::size_t>(signals_.attitude) == 0;
  for (std::size_t k = 0; k < 4; ++k) log_.q_WB[k].push_back(sampled ? q[static_cast<int>(k)] : kNaN);
}

void Recorder::command(std::span<const double> delta) {
  for (std::size_t n = 0; n < log_.delta.size(); ++n) log_.delta[n].push_back(delta[n]);
}

Vec3<double> Recorder::rates() const {
  Vec3<double> shown;
  for (std::size_t k = 0; k < 3; ++k)
    shown[static_cast<int>(k)] = log_.w_B[k].empty() ? kNaN : log_.w_B[k].back();
  return shown.allFinite() ? Vec3<double>(shown - gyro_bias_) : plant_->state().body.w_B;
}

void Recorder::row(double voltage_ratio) {
  const FlightState<double>& x = plant_->state();
  const Motion motion = seen_motion_.front();
  seen_motion_.pop_front();
  for (std::size_t n = 0; n < log_.Omega.size(); ++n)
    log_.Omega[n].push_back(
        seen(signals_.rotor_speeds, x.motors[n].Omega, noise_.rotor_speed * hover_speed_));
  add(motion.gyro + gyro_bias_, signals_.rates, noise_.gyro, log_.w_B);
  add(plant_->imu().f_B, signals_.force, noise_.accelerometer, log_.f_B);
  add(x.body.x_W, signals_.position, noise_.position, log_.x_W);
  add(x.body.v_W, signals_.velocity, noise_.velocity, log_.v_W);
  add_attitude(motion.q_WB);
  if (const auto full = plant_->vehicle().battery_voltage; full && signals_.battery > 0)
    log_.vbat.push_back(seen(signals_.battery, *full * voltage_ratio, *full * noise_.voltage));
  log_.t.push_back(plant_->t());
}

}  // namespace ident
