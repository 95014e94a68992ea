// Rows of a log out of readings.
#include "ident/fly/flight_record.h"

namespace ident {

void add_row(FlightLog& log, const Readings& r, std::span<const double> delta) {
  log.t.push_back(r.t);
  log.delta.resize(delta.size()), log.Omega.resize(r.Omega.size());
  for (std::size_t n = 0; n < delta.size(); ++n) log.delta[n].push_back(delta[n]);
  for (std::size_t n = 0; n < r.Omega.size(); ++n) log.Omega[n].push_back(r.Omega[n]);
  for (std::size_t k = 0; k < 3; ++k) {
    const int i = static_cast<int>(k);
    log.w_B[k].push_back(r.gyro_B[i]), log.f_B[k].push_back(r.f_B[i]);
    log.x_W[k].push_back(r.x_W[i]), log.v_W[k].push_back(r.v_W[i]);
  }
  for (std::size_t k = 0; k < 4; ++k) log.q_WB[k].push_back(r.q_WB[static_cast<int>(k)]);
  if (r.voltage) log.vbat.push_back(*r.voltage);
}

}  // namespace ident
