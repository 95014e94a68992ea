// Logs of controllers that are faster than the log.
#pragma once

#include "ident/data/flight_log.h"

namespace ident::testing {

/// Every so many rows of a log, without rotor speeds: commands that were not logged lie between.
inline FlightLog thinned(const FlightLog& log, std::size_t every) {
  FlightLog out = log;
  const auto thin = [&](std::vector<double>& column) {
    for (std::size_t i = 0; i * every < column.size(); ++i) column[i] = column[i * every];
    column.resize((column.size() + every - 1) / every);
  };
  const auto thin_all = [&](auto& columns) {
    for (auto& column : columns) thin(column);
  };
  thin(out.t);
  thin_all(out.delta), thin_all(out.w_B), thin_all(out.f_B), thin_all(out.q_WB), thin_all(out.v_W),
      thin_all(out.x_W);
  out.Omega.clear();
  return out;
}

}  // namespace ident::testing
