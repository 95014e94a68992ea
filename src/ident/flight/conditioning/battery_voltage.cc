// Says so.
#include "ident/flight/conditioning/battery_voltage.h"

#include <fmt/format.h>

#include <vector>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"

namespace ident {

std::optional<Warning> battery_not_modelled(const Vehicle& vehicle, std::span<const FlightLog> logs) {
  constexpr double kLittle = 0.02;  // of the voltage: two per cent of a rotor's speed
  constexpr double kSpikes = 0.05;  // share of the samples to either side
  if (vehicle.has("battery_sag.n") || vehicle.has("battery_sag.rate")) return {};
  std::vector<double> volts;
  for (const FlightLog& log : logs)
    if (log.has_commands())
      for (const double v : log.vbat)
        if (v > 0) volts.push_back(v);
  if (volts.empty()) return {};
  const double low = quantile(volts, kSpikes), high = quantile(volts, 1 - kSpikes);
  if (!(high - low > kLittle * high)) return {};
  return Warning{
      "battery_not_modelled",
      fmt::format("The battery falls from {} to {} V, and the model has no battery_sag. km is a mean over "
                  "the flight, which may bias what depends on it. State battery_sag.n in the vehicle file (1 "
                  "if speeds follow the voltage), and battery_voltage, at which km holds.",
                  format_number(high, 3), format_number(low, 3))};
}

}  // namespace ident
