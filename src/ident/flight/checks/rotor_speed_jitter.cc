// Second differences, to which motion adds nothing.
//
// A rotor that turns by x faster than the fit thrusts by 2 kT Omega x more:
//
//   residual of f_z = kT/m sum_n a_nz 2 Omega_n (residual of Omega_n) share + noise               (1)
#include "ident/flight/checks/rotor_speed_jitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "ident/model/vehicle.h"

namespace ident {
namespace {

// What (1) predicts for a share of one, and what is left of f_z, in each row of a chunk; NaN without a
// sample.
struct Row {
  double expected = kNaN, seen = kNaN;
};

}  // namespace

Warning FeltJitter::warning(const std::string& consequence) const {
  return {
      "speeds_jitter",
      fmt::format(
          "Rotor speeds jump from row to row without a command, and the vehicle feels {:.0f} % of that: {}",
          100 * std::min(share, 1.0), consequence)};
}

bool may_do_without_commands(std::span<const FlightLog> logs, std::span<const std::string> free) {
  static constexpr std::array<std::string_view, 5> kByCommands = {"km", "omega_m", "zeta_m", "dead_time",
                                                                  "Omega_0"};
  return std::ranges::all_of(logs, &FlightLog::has_rotor_speeds) &&
         std::ranges::find_first_of(free, kByCommands) == free.end();
}

std::vector<FlightLog> without_commands(std::span<const FlightLog> logs) {
  std::vector<FlightLog> out(logs.begin(), logs.end());
  for (FlightLog& log : out) log.delta.clear();
  return out;
}

FeltJitter felt_jitter(const FlightRecord& record, const Theta& theta, const FlightFit& fit) {
  FeltJitter out;
  if (!record.signals.commands || !record.signals.rotor_speeds || !record.signals.force) return out;
  const std::vector<double> p = theta.p(fit.u);
  const auto residuals = fit.smoother->residuals();
  const auto& places = fit.smoother->chunks();
  const auto sigma = [&](int channel) { return fit.noise.sigma[static_cast<std::size_t>(channel)]; };
  double xx = 0, xy = 0, yy = 0, n = 0, next = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
    std::vector<Row> rows(places[k].end - places[k].begin);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double *r = residuals[k].data() + i * kChannels,
                   *y = arc.y.data() + (places[k].begin + i) * kChannels;
      double expected = 0;
      for (std::size_t rotor = 0; rotor < record.vehicle->rotors.size(); ++rotor) {
        const int channel = kRotorChannel + static_cast<int>(rotor);
        const double a_z = axis_at(record.vehicle->rotors[rotor], p[param::alpha])[2];
        expected += a_z * 2 * y[channel] * r[channel] * sigma(channel);
      }
      // (1)
      rows[i] = {p[param::kT] / p[param::m] * expected, r[kForce + 2] * sigma(kForce + 2)};
    }
    double before = kNaN;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      const auto second = [&](double Row::*of) {
        return rows[i].*of - 2 * rows[i - 1].*of + rows[i - 2].*of;
      };
      const double x = second(&Row::expected), y = second(&Row::seen);
      if (std::isfinite(x * before)) next += x * before;
      before = x;
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      xx += x * x, xy += x * y, yy += y * y, n += 1;
    }
  }
  if (n < 100 || !(xx > 0)) return out;
  out.share = xy / xx, out.neighbours = next / xx;
  out.size =
      std::sqrt(xx / (6 * n)) / record.vehicle->g;  // second differences of what is white have six times that
  // Neighbours share samples: some three rows tell as much as one.
  out.std = std::sqrt(std::max(yy - out.share * xy, 0.0) / (n / 3) / xx);
  return out;
}

}  // namespace ident
