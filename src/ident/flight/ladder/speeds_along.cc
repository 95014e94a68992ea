// The model's motors from row to row; what was measured enters nowhere but at the beginning.
#include "ident/flight/ladder/speeds_along.h"

#include <cmath>

#include "ident/core/math.h"
#include "ident/flight/record/motor_start.h"

namespace ident {
namespace {

double measured_speed(const MeasuredArc& measured, std::size_t i, std::size_t n) {
  const double y = measured.arc->y[measured.row[i] * kChannels + kRotorChannel + n];
  return std::isfinite(y) && y > 0 ? y : std::nan("");
}

std::vector<RotorSpeeds> along(const MeasuredArc& measured, const Vehicle& vehicle,
                               std::span<const double> p) {
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, *measured.arc->inputs);
  const std::vector<double>& t = measured.t;
  std::array<MotorState<double>, kMaxRotors> motors = motors_at_start(flight, t[0], vehicle.rotors.size());
  for (std::size_t n = 0; n < vehicle.rotors.size(); ++n)
    if (const double y = measured_speed(measured, 0, n); std::isfinite(y)) motors[n].Omega = y;
  std::vector<RotorSpeeds> out(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (std::size_t n = 0; n < vehicle.rotors.size(); ++n) out[i][n] = motors[n].Omega;
    if (i + 1 < t.size()) flight.advance(motors, t[i], t[i + 1] - t[i]);
  }
  return out;
}

}  // namespace

std::vector<std::vector<RotorSpeeds>> measured_speeds(const MeasuredMotion& motion) {
  std::vector<std::vector<RotorSpeeds>> all;
  for (const MeasuredArc& arc : motion.arcs) {
    std::vector<RotorSpeeds>& out = all.emplace_back(arc.t.size());
    for (std::size_t i = 0; i < arc.t.size(); ++i)
      for (std::size_t n = 0; n < motion.record->vehicle->rotors.size(); ++n)
        out[i][n] = measured_speed(arc, i, n);
  }
  return all;
}

std::vector<std::vector<RotorSpeeds>> speeds_along(const MeasuredMotion& motion, std::span<const double> p) {
  std::vector<std::vector<RotorSpeeds>> all;
  for (const MeasuredArc& arc : motion.arcs) all.push_back(along(arc, *motion.record->vehicle, p));
  return all;
}

}  // namespace ident
