// Motors with their speed controllers, and the history of commands that transport delay needs.
#include "drive.h"

#include <algorithm>
#include <cmath>

namespace withheld {

void Commands::push(double t, const Four& delta) {
  t_.push_back(t);
  delta_.push_back(delta);
}

Four Commands::mean(double from, double to) const {
  if (from <= t_.front()) from = t_.front() - 1e-9, to = std::max(to, from + 1e-12);
  cursor_ = std::min(cursor_, t_.size() - 1);
  while (cursor_ > 0 && t_[cursor_] > from) --cursor_;
  while (cursor_ + 1 < t_.size() && t_[cursor_ + 1] <= from) ++cursor_;
  Four sum = Four::Zero();
  double at = from;
  for (std::size_t i = cursor_; at < to; ++i) {
    const double until = i + 1 < t_.size() ? std::min(t_[i + 1], to) : to;
    sum += (until - at) * delta_[i];
    at = until;
  }
  return sum / (to - from);
}

Four rotor_acceleration(const Vehicle& v, const Effects& e, const Four& target, const Four& Omega,
                        const Four& dOmega) {
  Four result;
  for (int i = 0; i < kRotors; ++i) {
    const double rate = v.omega_m * (target[i] < Omega[i] ? 1 - e.slow_spin_down : 1.0);
    result[i] = rate * rate * (target[i] - Omega[i]) - 2 * v.zeta_m * rate * dOmega[i];
  }
  return result;
}

double speed_per_command(const Vehicle& v, const Effects& e, double voltage_ratio) {
  return e.sag == 0 ? v.km : v.km * std::pow(voltage_ratio, e.sag);
}

Four follow_with_play(const Four& output, const Four& input, double width) {
  const Four low = input.array() - 0.5 * width, high = input.array() + 0.5 * width;
  return output.cwiseMax(low).cwiseMin(high);
}

std::vector<Spin> predict_spin(const Vehicle& v, const Effects& e, const Commands& commands,
                               const std::vector<double>& voltage_ratio, const Spin& start) {
  std::vector<Spin> result{start};
  result.reserve(commands.size());
  Four played = commands.delta(0);
  Commands effective;
  for (std::size_t k = 0; k < commands.size(); ++k) {
    played = e.backlash > 0 ? follow_with_play(played, commands.delta(k), e.backlash) : commands.delta(k);
    effective.push(commands.time(k), played);
  }
  Spin s = start;
  for (std::size_t k = 0; k + 1 < commands.size(); ++k) {
    const double t = commands.time(k), span = commands.time(k + 1) - t;
    const int steps = static_cast<int>(std::ceil(span / kStep - 1e-9));
    const double h = span / steps, gain = speed_per_command(v, e, voltage_ratio[k]);
    for (int j = 0; j < steps; ++j) {
      const double at = t + j * h - e.command_delay;
      const Four target = gain * effective.mean(at, at + h);
      const auto acc = [&](const Four& O, const Four& d) { return rotor_acceleration(v, e, target, O, d); };
      const Four d1 = s.dOmega, a1 = acc(s.Omega, d1);
      const Four d2 = d1 + 0.5 * h * a1, a2 = acc(s.Omega + 0.5 * h * d1, d2);
      const Four d3 = d1 + 0.5 * h * a2, a3 = acc(s.Omega + 0.5 * h * d2, d3);
      const Four d4 = d1 + h * a3, a4 = acc(s.Omega + h * d3, d4);
      s.Omega += h / 6 * (d1 + 2 * d2 + 2 * d3 + d4);
      s.dOmega += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    result.push_back(s);
  }
  return result;
}

}  // namespace withheld
