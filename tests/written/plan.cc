// Phases and steps of a flight.
#include "plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "random.h"

namespace written {
namespace {

constexpr double kHeight = 6;   // m
constexpr double kChip = 0.12;  // s, of the binary sequence

// +1 for a third of the period, -1 for a third, then 0.
double doublet(double t, double period) {
  const double phase = std::fmod(t, period) / period;
  return phase < 1.0 / 3 ? 1 : phase < 2.0 / 3 ? -1 : 0;
}

}  // namespace

Plan::Plan(std::uint64_t seed, double vigour) : vigour_(vigour) {
  Random random(seed ^ 0x91a7u);
  for (double t = 0; t < kEnd + 1; t += kChip) {
    Vector3d chip;
    for (double& sign : chip) sign = random.sign();
    chips_.push_back(chip);
  }
}

Wish Plan::at(double t) const {
  Wish w;
  w.height = std::clamp(1.5 * (t - kTakeOff), -0.5, kHeight);
  if (t >= kDescend) {
    w.hold_height = false;
    w.v_W.z() = t < kDescend + 5 ? 1.0 : 0.6;
    return w;
  }
  if (t < kManoeuvres) return w;
  const double s = t - kManoeuvres;  // 0 to 41 s
  const double turn = vigour_;
  if (s < 8)
    w.roll = 0.35 * doublet(s, 2);
  else if (s < 16)
    w.pitch = 0.35 * doublet(s, 2);
  else if (s < 22)
    w.yaw_rate = 1.5 * doublet(s - 16, 3);
  else if (s < 29)
    w.hold_height = false, w.v_W.z() = -1.6 * doublet(s - 22, 3.5);
  else if (s < 36)
    w.v_W = 3.5 * Vector3d(std::cos(0.9 * (s - 29)), std::sin(0.9 * (s - 29)), 0);
  else if (s < 40)
    w.roll = 0.25 * doublet(s, 1.3), w.pitch = 0.25 * doublet(s + 0.4, 1.7), w.yaw_rate = doublet(s, 2);
  if (s < 40) w.rate = 0.6 * turn * chips_[static_cast<size_t>(t / kChip)].cwiseProduct(Vector3d(1, 1, 0.5));
  return w;
}

}  // namespace written
