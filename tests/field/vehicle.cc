// Draws mass, geometry, propellers, motors and battery that go together.
#include "vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace field {
namespace {

using std::numbers::pi;

// Positions and spins: neighbours turn in opposite senses.
std::vector<Hub> place_hubs(const std::string& layout, double l, double height) {
  const int count = layout == "hex" ? 6 : 4;
  const double first = layout == "x" ? pi / 4 : layout == "hex" ? pi / 6 : 0;
  std::vector<Hub> hubs;
  for (int i = 0; i < count; ++i) {
    const double angle = first - 2 * pi * i / count;  // the first front right or front, then to the left
    const auto drawn = [](double x) {
      return std::round(x * 1e6) * 1e-6;
    };  // to a micrometre, as the file states it
    hubs.push_back({Vector3d(drawn(l * std::cos(angle)), drawn(l * std::sin(angle)), drawn(height)),
                    i % 2 == 0 ? 1.0 : -1.0});
  }
  return hubs;
}

Battery draw_battery(Random& random, const Vehicle& v) {
  Battery b;
  b.cells = v.m < 0.08   ? 1
            : v.m < 0.35 ? random.pick({2, 3})
            : v.m < 1    ? random.pick({3, 4})
                         : random.pick({4, 6});
  const double speed = v.hover_speed();
  const double power = v.rotors() * v.kQ * speed * speed * speed / b.efficiency;
  b.reference = 3.9 * b.cells;
  const double current = power / b.reference;
  b.capacity = current * random.uniform(360, 720);  // 6 to 12 min of hover
  b.R = random.uniform(0.02, 0.06) * b.reference / current;
  b.R_slow = random.uniform(0.01, 0.03) * b.reference / current;
  b.slow = random.uniform(5, 20);
  b.base_current = 0.05 * current;
  return b;
}

}  // namespace

double Vehicle::disc() const { return pi * radius * radius; }
double Vehicle::hover_speed() const { return std::sqrt(m * kGravity / (rotors() * kT)); }
double Vehicle::hover_inflow() const {
  return std::sqrt(m * kGravity / rotors() / (2 * kAirDensity * disc()));
}

Vehicle draw_vehicle(Random& random) {
  Vehicle v;
  v.m = random.log_uniform(0.03, 2.0);
  v.layout = v.m > 0.6 && random.chance(0.3) ? "hex" : random.chance(0.8) ? "x" : "plus";
  v.l = 0.046 * std::pow(v.m / 0.03, 0.42) * random.uniform(0.9, 1.15);
  const double space = v.layout == "hex" ? 0.45 : 0.62;  // neighbours must not touch
  v.radius = v.l * space * random.uniform(0.8, 1.0);
  v.hubs = place_hubs(v.layout, v.l, -random.uniform(0.0, 0.15) * v.l);
  const double thrust_coefficient = random.uniform(0.010, 0.018);
  v.kT = thrust_coefficient * kAirDensity * v.disc() * v.radius * v.radius;
  v.kQ = v.kT * v.radius * random.uniform(0.09, 0.15);
  v.Jp = 3e-6 * std::pow(v.m / 0.24, 1.5) * random.uniform(0.5, 1.5);
  const double thrust_to_weight = random.uniform(1.9, v.m < 0.08 ? 2.4 : 4.0);
  const double full = v.hover_speed() * std::sqrt(thrust_to_weight);
  v.Omega_0 = random.chance(0.3) ? full * random.uniform(0.05, 0.15) : 0;
  v.km = full - v.Omega_0;
  v.lag_up = (v.m < 0.08 ? random.uniform(0.025, 0.06) : random.uniform(0.02, 0.05)) * (v.m > 1 ? 1.4 : 1.0);
  v.lag_down = v.lag_up * random.uniform(1.15, 1.7);
  v.latency = random.pick({0.0, 0.001, 0.002, 0.004});
  const double gyration = v.l * random.uniform(0.38, 0.48);
  v.J.x() = v.m * gyration * gyration;
  v.J.y() = v.J.x() * random.uniform(0.9, 1.3);
  v.J.z() = (v.J.x() + v.J.y()) * random.uniform(0.82, 0.96);
  v.battery = draw_battery(random, v);
  return v;
}

}  // namespace field
