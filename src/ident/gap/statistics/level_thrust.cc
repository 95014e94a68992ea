// Stretches of every arc, then one line through all.
#include "ident/gap/statistics/level_thrust.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "ident/core/statistics.h"
#include "ident/model/flight.h"

namespace ident {
namespace {

constexpr double kStretch = 2.0;  // s: longer than motors and manoeuvres, shorter than a battery's sag
constexpr std::size_t kFewest = 6;
constexpr double kVoltageMoves = 0.02;  // of itself within a log
constexpr double kVaries = 0.02;
constexpr double kExplained = 0.75;
constexpr double kLeastExponent = 0.2, kMostExponent = 2.0;
constexpr int kLogs = 2;

struct Stretch {
  int log;
  double voltage, force;  // logarithms
};

void add_stretches(const FlightRecord& record, const FlightArc& arc, const std::vector<double>& p,
                   std::vector<Stretch>& out) {
  const NoEffects none;
  const Flight<double> flight(*record.vehicle, p, none, *arc.inputs);
  double force = 0, squares = 0, voltage = 0, rows = 0, from = arc.t.front();
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    if (arc.t[i] - from >= kStretch) {
      if (rows > 0 && force > 0 && squares > 0)
        out.push_back({arc.log, std::log(voltage / rows), std::log(force / squares)});
      force = squares = voltage = rows = 0, from = arc.t[i];
    }
    const double az = arc.y[i * kChannels + kForce + 2], ratio = arc.inputs->voltage_ratio[i];
    if (!std::isfinite(az) || !std::isfinite(ratio)) continue;
    for (std::size_t n = 0; n < record.vehicle->rotors.size(); ++n)
      squares += std::pow(flight.steady_speed(n, arc.t[i]), 2);
    force -= az, voltage += ratio, rows += 1;
  }
}

double slope(const std::vector<Stretch>& all, double& left) {
  std::vector<double> x, y;
  for (const Stretch& s : all) x.push_back(s.voltage), y.push_back(s.force);
  const double mx = mean(x), my = mean(y);
  double xx = 0, xy = 0, rest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  const double b = xy / xx;
  for (std::size_t i = 0; i < x.size(); ++i) rest += std::pow(y[i] - my - b * (x[i] - mx), 2);
  left = std::sqrt(rest / static_cast<double>(x.size() - 2));
  return b;
}

}  // namespace

bool LevelThrust::plain() const {
  return logs >= kLogs && rising == logs && varies > kVaries && n > kLeastExponent && n < kMostExponent &&
         left * left < (1 - kExplained) * varies * varies;
}

LevelThrust level_thrust(const FlightRecord& record, const std::vector<double>& p) {
  LevelThrust out;
  if (!record.signals.commands || !record.signals.voltage || !record.signals.force) return out;
  std::vector<Stretch> all;
  for (const FlightArc& arc : record.arcs)
    if (arc.inputs->commanded() && !arc.inputs->voltage_ratio.empty()) add_stretches(record, arc, p, all);
  out.stretches = static_cast<int>(all.size());
  std::map<int, std::vector<Stretch>> by_log;
  for (const Stretch& s : all) by_log[s.log].push_back(s);
  double left = 0;
  for (const auto& [log, own] : by_log) {
    const auto [low, high] = std::ranges::minmax(own, {}, &Stretch::voltage);
    if (own.size() < kFewest || high.voltage - low.voltage < kVoltageMoves) continue;
    out.logs += 1;
    out.rising += slope(own, left) > 0 ? 1 : 0;
  }
  if (out.logs == 0) return out;
  std::vector<double> force, voltage;
  for (const Stretch& s : all) force.push_back(s.force), voltage.push_back(s.voltage);
  out.n = slope(all, out.left) / 2;  // thrust goes with the square of the speed
  out.varies = standard_deviation(force);
  out.n_std = out.left / (2 * standard_deviation(voltage) * std::sqrt(static_cast<double>(all.size() - 1)));
  return out;
}

}  // namespace ident
