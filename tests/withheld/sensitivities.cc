// Predicted instrument readings along a trajectory, and the list of all catalogue parameters as directions.
#include "sensitivities.h"

#include <algorithm>
#include <cmath>

namespace withheld {

using Eigen::Vector3d;

namespace {

// A length whose only prime factors are 2, 3 and 5, for the Fourier transform.
std::size_t smooth_length(std::size_t n) {
  for (; n > 1; --n) {
    std::size_t rest = n;
    for (const std::size_t factor : {2UL, 3UL, 5UL}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) break;
  }
  return n;
}

}  // namespace

Prediction::Prediction(const Flight& flight, const Instruments& instruments)
    : flight_(flight), every_(static_cast<std::size_t>(std::max(1.0, std::floor(instruments.rate / 100)))) {
  rows_ = static_cast<Eigen::Index>(smooth_length(flight.truth.size() / every_));
  rate_ = instruments.rate / static_cast<double>(every_);
  for (const Instant& now : flight.truth) voltage_ratio_.push_back(now.voltage / flight.reference_voltage);
}

const std::vector<Spin>& Prediction::spin(const Vehicle& v, const Effects& e) {
  const std::vector<double> key = {v.km, v.omega_m, v.zeta_m, e.sag, e.command_delay, e.slow_spin_down};
  for (const auto& [parameters, spins] : kept_) {
    if (parameters == key) return spins;
  }
  if (kept_.size() > 3) kept_.erase(kept_.begin() + 1);
  Effects drive = e;
  drive.backlash = 0;  // outside: a prediction knows nothing of it
  kept_.emplace_back(key,
                     predict_spin(v, drive, flight_.commands, voltage_ratio_, flight_.truth.front().spin));
  return kept_.back().second;
}

Channels Prediction::operator()(const Vehicle& v, const Effects& e) {
  const std::vector<Spin>& spins = spin(v, e);
  const Body body(v, e);
  const Eigen::Quaterniond to_imu = small_turn(e.imu_turn).conjugate();
  Channels y(rows_, kChannels);
  for (Eigen::Index k = 0; k < rows_; ++k) {
    const auto i = static_cast<std::size_t>(k) * every_;
    const Instant& now = flight_.truth[i];
    Wrench wrench = rotor_wrench(v, e, now.motion, now.air, spins[i].Omega, spins[i].dOmega);
    const Wrench on_body = body_wrench(v, e, now.motion, now.air);
    wrench.F += on_body.F;
    wrench.M += on_body.M;
    const Acceleration a = accelerate(body, wrench, now.motion.w);
    const Vector3d& w = now.motion.w;
    const Vector3d at_imu = a.f + a.dw.cross(e.imu_at) + w.cross(w.cross(e.imu_at));
    const Eigen::Quaterniond late = small_turn(w * e.sensor_delay).conjugate();  // attitude shown behind
    y.row(k) << (to_imu * at_imu + e.acc_bias).transpose(), (late.conjugate() * a.f).transpose(),
        a.dw.transpose(), a.dw.transpose(), spins[i].Omega.transpose();
  }
  if (e.sensor_delay > 0) {
    const double shift = e.sensor_delay * rate_;
    const Channels before = y;
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const double at = std::max(0.0, static_cast<double>(k) - shift);
      const auto low = static_cast<Eigen::Index>(at);
      const double part = at - static_cast<double>(low);
      const Eigen::Index high = std::min(low + 1, rows_ - 1);
      y.row(k).segment<6>(6) =
          (1 - part) * before.row(low).segment<6>(6) + part * before.row(high).segment<6>(6);
    }
  }
  for (Eigen::Index k = 0; k < rows_; ++k) {
    y.row(k).segment<3>(6) = (to_imu * Vector3d(y.row(k).segment<3>(6).transpose())).transpose();
  }
  return y;
}

Channels Prediction::recorded() const {
  Channels y(rows_, kChannels);
  for (Eigen::Index k = 0; k < rows_; ++k) {
    const Instant& now = flight_.truth[static_cast<std::size_t>(k) * every_];
    y.row(k) << now.acceleration.f.transpose(), now.acceleration.f.transpose(),
        now.acceleration.dw.transpose(), now.acceleration.dw.transpose(), now.spin.Omega.transpose();
  }
  return y;
}

std::vector<Direction> catalogue_directions(const Vehicle& v) {
  std::vector<Direction> all;
  const double kd = v.m * 0.3 / (kRotors * v.hover_speed());
  const auto one = [&](const char* effect, double Effects::*member, double step) {
    all.push_back({effect, [member](Effects& e, double x) { e.*member += x; }, step, nullptr});
  };
  const auto three = [&](const char* effect, Vector3d Effects::*member, double step) {
    for (int i = 0; i < 3; ++i) {
      all.push_back({effect, [member, i](Effects& e, double x) { (e.*member)[i] += x; }, step, nullptr});
    }
  };
  one("rotor_drag", &Effects::drag, 0.1 * kd);
  one("parasitic_drag", &Effects::body_drag, 0.002);
  one("translational_lift", &Effects::lift_gain, 0.01);
  one("axial_inflow", &Effects::inflow, 0.1 * kd);
  one("blade_flapping", &Effects::flap_moment, 0.02 * kd * v.radius);
  one("ground_effect", &Effects::ground, 0.1);
  for (int i = 0; i < 3; ++i) {
    all.push_back(
        {"wind", [i](Effects& e, double x) { e.wind[i] += x; }, 0.2, [kd](Effects& e) { e.drag += kd; }});
  }
  one("wind", &Effects::drag, 0.1 * kd);
  one("battery_sag", &Effects::sag, 0.05);
  one("motor_delay", &Effects::command_delay, 0.001);
  one("sensor_delay", &Effects::sensor_delay, 0.001);
  one("motor_asymmetry", &Effects::slow_spin_down, 0.02);
  one("thrust_curve", &Effects::thrust_power, 0.01);
  one("gyroscopic", &Effects::Jp, 1e-4 * v.J.x());
  for (int i = 0; i < kRotors; ++i) {
    all.push_back({"rotor_mismatch", [i](Effects& e, double x) { e.weakness[i] += x; }, 0.01, nullptr});
    for (int axis = 0; axis < 2; ++axis) {
      all.push_back(
          {"rotor_tilt", [i, axis](Effects& e, double x) { e.tilt(axis, i) += x; }, 0.005, nullptr});
    }
  }
  three("cg_offset", &Effects::cg, 1e-3 * v.arm);
  all.push_back({"payload", [](Effects& e, double x) { e.payload += x; }, 0.01 * v.m, nullptr});
  for (int i = 0; i < 3; ++i) {
    all.push_back({"payload", [i](Effects& e, double x) { e.payload_at[i] += x; }, 0.01 * v.arm,
                   [m = v.m](Effects& e) { e.payload += 0.05 * m; }});
  }
  three("products_of_inertia", &Effects::products, 0.01 * v.J.x());
  three("imu_bias", &Effects::acc_bias, 0.02);
  three("imu_lever_arm", &Effects::imu_at, 0.01 * v.arm);
  three("imu_misalignment", &Effects::imu_turn, 0.005);
  return all;
}

}  // namespace withheld
