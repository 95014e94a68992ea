// Flights whose rotors jump in every row as no command says.
#pragma once

#include "support/known_quad.h"

namespace ident::testing {

// A log of rates and specific force whose rotors jump off what was simulated in every row, rad/s, as the
// vehicle feels along z and about all axes, and the log shows but for the noise of its sensor.
inline FlightLog with_jumping_speeds(const Vehicle& truth, double jumps, double sensor,
                                     std::uint64_t seed = 3) {
  FlightLog log = flight(truth, 200, seed, 30);
  log.q_WB = {}, log.v_W = {}, log.x_W = {};
  Random random(8 + seed);
  std::array<double, 3> turned{};  // by what jumped before, rad/s
  for (std::size_t i = 0; i < log.t.size(); ++i) {
    double lift = 0, momentum = 0;
    std::array<double, 3> moment{};
    for (std::size_t n = 0; n < 4; ++n) {
      const double jump = jumps * random.normal(), Omega = log.Omega[n][i];
      const double more = truth.value("kT") * ((Omega + jump) * (Omega + jump) - Omega * Omega);
      const Eigen::Vector3d& r = truth.rotors[n].r_B;
      const double s = truth.rotors[n].s;
      lift += more, moment[0] -= r[1] * more, moment[1] += r[0] * more;
      moment[2] += s * truth.value("kQ") / truth.value("kT") * more, momentum += s * truth.value("Jp") * jump;
      log.Omega[n][i] += jump + sensor * random.normal();
    }
    log.f_B[2][i] -= lift / truth.value("m");
    static constexpr std::array J = {"Jxx", "Jyy", "Jzz"};
    for (std::size_t k = 0; k < 3; ++k) {
      log.w_B[k][i] += turned[k];
      turned[k] += moment[k] / truth.value(J[k]) * 0.005;
    }
    log.w_B[2][i] += momentum / truth.value("Jzz");
  }
  return log;
}

}  // namespace ident::testing
