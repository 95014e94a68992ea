// Dryden's filters, driven by white noise.
#include "air.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace field {
namespace {

// Ornstein-Uhlenbeck: x(t + dt) = d x + sigma sqrt(1 - d^2) n.
void advance(Vector3d& x, const Vector3d& decay, const Vector3d& sigma, Random& random) {
  for (int i = 0; i < 3; ++i) {
    x[i] = decay[i] * x[i] + sigma[i] * std::sqrt(1 - decay[i] * decay[i]) * random.normal();
  }
}

}  // namespace

AirLevel air_level(const std::string& name) {
  if (name == "indoors") return {name, 0.05, 0.05};
  if (name == "calm") return {name, 0.3, 0.3};
  if (name == "light") return {name, 1.49, 0.77};
  if (name == "moderate") return {name, 2.98, 1.54};
  throw std::invalid_argument("no such air: " + name);
}

Gusts::Gusts(const AirLevel& level, double share, double span, Random random, double dt) : random_(random) {
  const Vector3d total = share * Vector3d(level.across, level.across, level.along);
  // Nine tenths of the variance in large eddies, the rest in eddies of about a metre.
  sigma_ = std::sqrt(0.9) * total;
  fast_sigma_ = std::sqrt(0.1) * total;
  const Vector3d slow = level.across < 0.1 ? Vector3d(2, 2, 2) : Vector3d(6, 4, 1.2);  // s
  for (int i = 0; i < 3; ++i) {
    decay_[i] = std::exp(-dt / slow[i]);
    fast_decay_[i] = std::exp(-dt / random_.uniform(0.1, 0.3));
  }
  // Eddies of a metre turn the air over the span of the vehicle.
  turn_sigma_ = fast_sigma_.z() / std::max(1.0, 4 * span);
  turn_decay_ = std::exp(-dt / random_.uniform(0.1, 0.3));
  for (int i = 0; i < 3; ++i) slow_v_[i] = sigma_[i] * random_.normal();
}

AirSample Gusts::next() {
  advance(slow_v_, decay_, sigma_, random_);
  advance(fast_v_, fast_decay_, fast_sigma_, random_);
  advance(turning_, Vector3d::Constant(turn_decay_), Vector3d::Constant(turn_sigma_), random_);
  return {.v_W = slow_v_ + fast_v_, .turning_B = turning_};
}

std::vector<Burst> draw_bursts(Random& random, double duration, double hover_inflow) {
  std::vector<Burst> bursts;
  const int count = random.integer(2, 5);
  for (int i = 0; i < count; ++i) {
    bursts.push_back({.from = random.uniform(2, duration - 2),
                      .length = random.uniform(0.4, 1.5),
                      .speed = hover_inflow * random.uniform(0.3, 1.0)});
  }
  return bursts;
}

double burst_speed(const std::vector<Burst>& bursts, double t) {
  double speed = 0;
  for (const Burst& b : bursts) {
    const double phase = (t - b.from) / b.length;
    if (phase > 0 && phase < 1) speed += b.speed * std::pow(std::sin(std::numbers::pi * phase), 2);
  }
  return speed;
}

}  // namespace field
