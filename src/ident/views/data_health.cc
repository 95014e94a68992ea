// Tables of the noise levels found and of what was left out.
#include "ident/views/data_health.h"

#include <fmt/format.h>

#include <cmath>

#include "ident/core/format_number.h"
#include "ident/flight/record/channel_units.h"

namespace ident {

Section data_health(const FlightRecord& record, std::span<const FlightLog> logs, const NoiseModel& noise,
                    const Vibration& vibration) {
  Section section;
  section.title = "Data health";
  for (const FlightLog& log : logs)
    for (const std::string& notice : log.notices) section.text += notice + "\n";
  section.text += fmt::format("{:.1f} s in flight in {} piece{}, one row every {:.4g} s.", record.duration,
                              record.arcs.size(), record.arcs.size() == 1 ? "" : "s", record.interval);
  Table table{"Noise levels found", {"channel", "white noise", "unit", "samples"}, {}};
  for (int c = 0; c < kChannels; ++c) {
    std::size_t samples = 0;
    for (const FlightArc& arc : record.arcs)
      for (std::size_t i = 0; i < arc.rows(); ++i)
        samples += std::isfinite(arc.y[i * kChannels + static_cast<std::size_t>(c)]);
    if (samples > 0)
      table.rows.push_back({channel_name(c), format_number(noise.sigma[static_cast<std::size_t>(c)], 3),
                            channel_unit(c), std::to_string(samples)});
  }
  section.tables.push_back(table);
  if (vibration.found()) {
    Table felt{"Vibration by rotor, at the usual speed", {"rotor", "times the sensors' noise"}, {}};
    for (std::size_t n = 0; n < vibration.of_rotor.size(); ++n)
      felt.rows.push_back({std::to_string(n + 1), format_number(vibration.of_rotor[n], 2)});
    section.tables.push_back(felt);
  }
  return section;
}

}  // namespace ident
