// Generated sweeps for tests of single properties.
#include "support/thrust_tables.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace ident::bench {
namespace {

constexpr double kT = 6e-6, kQ = 9e-8, kTareT = 0.1, kTareQ = -0.002;
constexpr double kTop = 1150.0;

struct Columns {
  std::vector<double> t, omega, thrust, torque, delta;

  NumberTable table(const std::string& file, bool with_time, bool with_command) const {
    NumberTable made{.file = file};
    made.columns = {{"omega", "omega", omega}, {"thrust", "thrust", thrust}, {"torque", "torque", torque}};
    if (with_command) made.columns.push_back({"delta", "delta", delta});
    if (with_time) made.columns.push_back({"t", "t", t});
    for (std::size_t i = 0; i < omega.size(); ++i) made.line.push_back(static_cast<long>(i) + 2);
    return made;
  }
};

/// A log of a rotor whose speed is a function of time.
template <class SpeedAt>
Columns log_of(double duration, double lag, double drift, unsigned seed, const SpeedAt& speed_at) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  constexpr double step = 0.02;
  Columns c;
  double seen = 0.0;  // squared speed behind the load cell's lag
  for (int i = 0; i * step < duration; ++i) {
    const double t = i * step, Omega = speed_at(t);
    seen += (1.0 - std::exp(-step / lag)) * (Omega * Omega - seen);
    c.t.push_back(t);
    c.omega.push_back(Omega > 0.0 ? Omega + 1.0 * normal(random) : 0.0);
    c.thrust.push_back(kTareT + drift * t / duration + kT * seen + 0.02 * normal(random));
    c.torque.push_back(kTareQ + kQ * seen + 3e-4 * normal(random));
  }
  return c;
}

}  // namespace

NumberTable SweepTable::table() const {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Columns c;
  double coloured_T = normal(random), coloured_Q = normal(random);
  const auto row = [&](double command, double Omega) {
    coloured_T = rho * coloured_T + std::sqrt(1 - rho * rho) * normal(random);
    coloured_Q = rho * coloured_Q + std::sqrt(1 - rho * rho) * normal(random);
    const double real = Omega > 0.0 ? Omega + speed_wander * normal(random) : 0.0;
    c.delta.push_back(command);
    c.omega.push_back(real > 0.0 ? real + speed_noise * normal(random) : 0.0);
    c.thrust.push_back(kTareT + linear_term * real + kT * real * real +
                       noise * kT * kTop * kTop * coloured_T);
    c.torque.push_back(kTareQ + kQ * real * real + noise * kQ * kTop * kTop * coloured_Q);
  };
  for (int i = 0; i < at_rest; ++i) row(0.0, 0.0);
  for (int s = 0; s < set_points; ++s)
    for (int i = 0; i < repeats; ++i) {
      const double command = 0.1 + 0.9 * s / (set_points - 1);
      row(command, 150.0 + 1000.0 * command);
    }
  return c.table("sweep.csv", false, true);
}

NumberTable& SweepTable::made() {
  if (made_.columns.empty()) made_ = table();
  return made_;
}

NumberTable staircase_table(const Staircase& options) {
  constexpr int steps = 10;
  constexpr double dwell = 4.0;
  const auto speed = [](double t) {
    const int k = static_cast<int>(t / dwell);
    if (k < 1 || k > steps) return 0.0;
    const double goal = 1050.0 * std::sqrt(static_cast<double>(k) / steps),
                 before = k > 1 ? 1050.0 * std::sqrt(static_cast<double>(k - 1) / steps) : 0.0;
    return goal + (before - goal) * std::exp(-(t - k * dwell) / 0.05);
  };
  return log_of((steps + 2) * dwell, 0.25, options.drift, 3, speed).table("log.csv", true, false);
}

NumberTable ramp_table(double lag) {
  const auto speed = [](double t) { return 200.0 + 950.0 * (1.0 - std::fabs(t - 10.0) / 10.0); };
  return log_of(20.0, lag, 0.0, 4, speed).table("ramp.csv", true, false);
}

std::vector<double>& values(NumberTable& table, const std::string& name) {
  for (Column& c : table.columns)
    if (c.name == name) return c.values;
  throw std::logic_error("the table has no column " + name);
}

void drop_column(NumberTable& table, const std::string& name) {
  std::erase_if(table.columns, [&](const Column& c) { return c.name == name; });
}

}  // namespace ident::bench
