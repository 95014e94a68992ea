// Integrates the speeds of the rotors; the battery sags under their current.
#include "drive.h"

#include <algorithm>
#include <cmath>

namespace field {

BatteryState::BatteryState(const Battery& battery, double charge)
    : battery_(battery), charge_(charge), voltage_(open_circuit()) {}

double BatteryState::open_circuit() const {  // a lithium cell: steep when full, steep when empty
  const double s = std::clamp(charge_, 0.0, 1.0);
  return battery_.cells * (3.55 + 0.45 * s + 0.2 * std::pow(s, 8) - 0.35 * std::exp(-s / 0.06));
}

void BatteryState::advance(double power, double dt) {
  current_ = power / battery_.efficiency / std::max(voltage_, 1.0) + battery_.base_current;
  charge_ -= current_ * dt / battery_.capacity;
  slow_drop_ += dt / battery_.slow * (battery_.R_slow * current_ - slow_drop_);
  voltage_ = open_circuit() - battery_.R * current_ - slow_drop_;
}

double commanded_speed(const Vehicle& v, double exponent, double command, double voltage) {
  const double gain = exponent > 0 ? std::pow(voltage / v.battery.reference, exponent) : 1.0;
  return (v.km * command + v.Omega_0) * gain;  // all of the speed goes with the voltage
}

Drive::Drive(const Vehicle& v, const Effects& e, DriveTraits traits, double dt, const PerRotor& Omega)
    : v_(v), e_(e), traits_(traits), dt_(dt), Omega_(Omega), dOmega_(PerRotor::Zero(Omega.size())) {
  taken_ = (Omega - v.Omega_0) / v.km;
  const int steps = traits.late ? static_cast<int>(std::lround(v.latency / dt)) : 0;
  on_the_way_.assign(static_cast<size_t>(steps), taken_);
}

void Drive::advance(const PerRotor& command, double voltage) {
  on_the_way_.push_back(command);
  const PerRotor arrived = on_the_way_.front();
  on_the_way_.pop_front();
  const double dead = traits_.dead_zone ? e_.dead_zone : 0;
  for (int i = 0; i < Omega_.size(); ++i) {
    if (std::abs(arrived[i] - taken_[i]) >= dead) taken_[i] = arrived[i];
    const double target = commanded_speed(v_, traits_.sags ? e_.sag_exponent : 0, taken_[i], voltage);
    const double lag = !traits_.asymmetric ? v_.lag() : target > Omega_[i] ? v_.lag_up : v_.lag_down;
    const double next = target + (Omega_[i] - target) * std::exp(-dt_ / lag);
    dOmega_[i] = (next - Omega_[i]) / dt_;
    Omega_[i] = next;
  }
}

}  // namespace field
