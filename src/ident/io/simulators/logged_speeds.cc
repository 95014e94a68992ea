// The ratio of measured speeds to the assumed ones, and what it scales.
#include "ident/io/simulators/logged_speeds.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"
#include "ident/io/file/read_bytes.h"
#include "ident/io/simulators/simulators.h"

namespace ident {
namespace {

constexpr std::size_t kLargestFile = 16u << 20;  // bytes
constexpr double kDriven = 0.05;                 // least command that says something of a speed
constexpr std::size_t kFewest = 20;              // samples

// Measured speed over the one for the command that holds, at each sample that has both. The lag of a motor
// scatters it to either side.
std::vector<double> over_commanded(const Vehicle& vehicle, std::span<const FlightLog> logs) {
  const double km = vehicle.value("km"), idle = vehicle.has("Omega_0") ? vehicle.value("Omega_0") : 0.0;
  std::vector<double> ratios;
  for (const FlightLog& log : logs)
    for (std::size_t n = 0; n < std::min(log.delta.size(), log.Omega.size()); ++n) {
      double command = kNaN;
      for (std::size_t i = 0; i < log.rows(); ++i) {
        if (std::isfinite(log.delta[n][i])) command = log.delta[n][i];
        if (command > kDriven && log.Omega[n][i] > 0)
          ratios.push_back(log.Omega[n][i] / (idle + km * command));
      }
    }
  return ratios;
}

// The same of speeds that carry the weight in the middle of the flight: thrust goes with their square.
std::vector<double> over_weight(const Vehicle& vehicle, std::span<const FlightLog> logs) {
  const double hover = vehicle.value("m") * vehicle.g / vehicle.value("kT");
  std::vector<double> ratios;
  for (const FlightLog& log : logs)
    for (std::size_t i = 0; i < log.rows(); ++i) {
      double square = 0;
      for (const std::vector<double>& speeds : log.Omega) square += speeds[i] * speeds[i];
      if (square > 0) ratios.push_back(std::sqrt(square / hover));
    }
  return ratios;
}

void scale(Vehicle& vehicle, const char* name, double factor) {
  const auto at = vehicle.parameters.find(name);
  if (at == vehicle.parameters.end()) return;
  at->second.value *= factor;
  if (at->second.std) *at->second.std *= factor;
}

}  // namespace

bool assumes_rotor_speeds(const std::string& path) {
  const SimulatorFormat* format = recognised_simulator(read_bytes(path, kLargestFile));
  return format && !format->holds.rotor_speeds;
}

Vehicle with_logged_speeds(Vehicle vehicle, std::span<const FlightLog> logs) {
  if (!vehicle.has("kT") || !vehicle.has("km") || !vehicle.has("m")) return vehicle;
  std::vector<double> ratios = over_commanded(vehicle, logs);
  if (ratios.empty()) ratios = over_weight(vehicle, logs);
  if (ratios.size() < kFewest) return vehicle;
  const double ratio = median(ratios);
  if (!(ratio > 0) || !std::isfinite(ratio)) return vehicle;
  for (const char* name : {"km", "Omega_0"}) scale(vehicle, name, ratio);
  for (const char* name : {"kT", "kQ"}) scale(vehicle, name, 1 / (ratio * ratio));
  scale(vehicle, "Jp", 1 / ratio);
  return vehicle;
}

}  // namespace ident
