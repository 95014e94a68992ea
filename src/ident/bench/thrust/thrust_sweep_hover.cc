// Hover power from kT, kQ and, where voltage and current are logged, from the battery.
#include "ident/bench/thrust/thrust_sweep_hover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ident/bench/thrust/thrust_sweep_rotor.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"

namespace ident {

double electrical_power(const SweepRows& rows, double Omega) {
  if (rows.voltage.empty() || rows.current.empty()) return kNaN;
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> by_set_point;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double power = rows.voltage[i] * rows.current[i];
    if (rows.set_point[i] < 0 || rows.at_rest[i] || !std::isfinite(power) || !(rows.Omega[i] > 0.0)) continue;
    by_set_point[rows.set_point[i]].first.push_back(rows.Omega[i]);
    by_set_point[rows.set_point[i]].second.push_back(power);
  }
  std::vector<std::pair<double, double>> curve;
  for (const auto& [set_point, values] : by_set_point)
    curve.emplace_back(median(values.first), median(values.second));
  std::ranges::sort(curve);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto& [low, low_power] = curve[i - 1];
    const auto& [high, high_power] = curve[i];
    if (Omega < low || Omega > high || !(high > low)) continue;
    return low_power + (Omega - low) / (high - low) * (high_power - low_power);
  }
  return kNaN;
}

void add_hover(Result& result, const std::vector<SweepFile>& files, const ThrustOptions& options,
               Section& section) {
  if (!options.hover_thrust) return;
  const double T = *options.hover_thrust, Omega = std::sqrt(T / result.find("kT")->value);
  nlohmann::ordered_json hover = {{"thrust_per_rotor", T}, {"rotor_speed", Omega}};
  Table table{.title = "A rotor at hover", .columns = {"quantity", "value"}};
  const auto say = [&](const char* key, const std::string& what, double value, const char* unit) {
    if (!std::isfinite(value)) return;
    hover[key] = value;
    table.rows.push_back({what, fmt::format("{} {}", format_number(value), unit)});
  };
  table.rows.push_back({"thrust", fmt::format("{} N", format_number(T))});
  table.rows.push_back({"rotor speed", fmt::format("{} rad/s", format_number(Omega))});
  const double ideal = options.radius ? momentum_power(T, *options.radius, options.rho) : kNaN;
  const double shaft = result.find("kQ") ? result.find("kQ")->value * Omega * Omega * Omega : kNaN;
  std::vector<double> powers;
  for (const SweepFile& file : files) powers.push_back(electrical_power(file.rows, Omega));
  const double electrical = mean(powers);
  say("momentum_power", "least power (momentum theory)", ideal, "W");
  say("shaft_power", "shaft power", shaft, "W");
  say("electrical_power", "electrical power, as logged", electrical, "W");
  say("figure_of_merit", "least over shaft power (figure of merit)", ideal / shaft, "");
  say("drive_efficiency", "shaft over electrical power", shaft / electrical, "");
  say("efficiency", "least over electrical power", ideal / electrical, "");
  result.extra["hover"] = hover;
  section.tables.push_back(std::move(table));
}

}  // namespace ident
