// Windows of flight for the test of the rotors' order.
#include "ident/flight/checks/rotor_windows.h"

#include <algorithm>
#include <cmath>

#include "ident/core/statistics.h"

namespace ident {
namespace {

// Rotor speeds as measured; of rotors that never were: zero.
std::vector<Track> measured_speeds(const FlightArc& arc, std::size_t rotors) {
  std::vector<Track> out(rotors, Track(arc.rows(), 0.0));
  for (std::size_t n = 0; n < rotors && n < arc.inputs->Omega.size(); ++n)
    if (arc.inputs->Omega[n].size() == arc.rows()) out[n] = arc.inputs->Omega[n];
  return out;
}

}  // namespace

Streams rotor_streams(const FlightArc& arc, const Vehicle& vehicle, std::span<const double> p,
                      bool measured) {
  Streams out;
  Track rate(arc.rows());
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < arc.rows(); ++i) rate[i] = arc.body[i].w_B[static_cast<Eigen::Index>(k)];
    out.rates[k] = rate;
  }
  for (const Track& speed :
       measured ? measured_speeds(arc, vehicle.rotors.size()) : simulated_speeds(arc, vehicle, p)) {
    Track square = speed;
    for (double& v : square) v *= v;
    out.thrust.emplace_back(integral(arc.t, square)), out.spin.emplace_back(speed);
    out.mean_square.push_back(std::pow(root_mean_square(speed), 2));
  }
  return out;
}

RotorWindows rotor_windows(const std::vector<Streams>& arcs, double interval, double lag, double shift) {
  const ChangeWindows windows = change_windows(lag, interval);
  const long rows = std::lround(shift * static_cast<double>(windows.margin));
  const std::size_t columns = arcs[0].thrust.size();
  RotorWindows out;
  Track3 rates;
  out.thrust.resize(columns), out.spin.resize(columns);
  for (const Streams& arc : arcs) {
    const auto& w = arc.rates;
    append(rates, {changes(w[0], windows), changes(w[1], windows), changes(w[2], windows)});
    for (std::size_t n = 0; n < columns; ++n) {
      const Track thrust = changes(arc.thrust[n], windows, rows), spin = changes(arc.spin[n], windows, rows);
      out.thrust[n].insert(out.thrust[n].end(), thrust.begin(), thrust.end());
      out.spin[n].insert(out.spin[n].end(), spin.begin(), spin.end());
    }
  }
  for (std::size_t k = 0; k < 3; ++k) out.rates[k] = clipped_unit(std::move(rates[k]));
  return out;
}

Eigen::Matrix3d correlation_of(const RotorWindows& windows, const std::vector<RotorMoment>& rotors,
                               const RotorOrder& order) {
  const std::size_t count = windows.count();
  Track3 moment{Track(count, 0.0), Track(count, 0.0), Track(count, 0.0)};
  for (std::size_t n = 0; n < order.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      const double by_thrust = rotors[n].by_thrust[static_cast<Eigen::Index>(k)],
                   by_spin = rotors[n].by_spin[static_cast<Eigen::Index>(k)];
      const Track &thrust = windows.thrust[order[n]], &spin = windows.spin[order[n]];
      for (std::size_t i = 0; i < count; ++i) moment[k][i] += by_thrust * thrust[i] + by_spin * spin[i];
    }
  for (Track& one : moment) one = clipped_unit(std::move(one));
  Eigen::Matrix3d r;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      r(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) =
          correlation(windows.rates[k], moment[j]);
  return r;
}

YawShares yaw_shares(const RotorWindows& windows, const std::vector<RotorMoment>& rotors,
                     const RotorOrder& order) {
  Track by_thrust(windows.count(), 0.0), by_spin = by_thrust;
  for (std::size_t n = 0; n < order.size(); ++n)
    for (std::size_t i = 0; i < windows.count(); ++i) {
      by_thrust[i] += rotors[n].by_thrust[2] * windows.thrust[order[n]][i];
      by_spin[i] += rotors[n].per_Jp[2] * windows.spin[order[n]][i];
    }
  by_thrust = clipped_unit(std::move(by_thrust)), by_spin = clipped_unit(std::move(by_spin));
  const double t = correlation(windows.rates[2], by_thrust), s = correlation(windows.rates[2], by_spin),
               both = correlation(by_thrust, by_spin);
  // Least squares over the two with weights of one sign.
  const auto share = [&](double sign) {
    if (sign < 0 && t > 0) return 0.0;  // drag as stated: it is not the spin that is wrong
    const double a = sign * (t - both * s), b = sign * (s - both * t);
    if (a > 0 && b > 0) return (a * sign * t + b * sign * s) / std::max(1 - both * both, 1e-9);
    return std::pow(std::max({sign * t, sign * s, 0.0}), 2);
  };
  return {share(1.0), share(-1.0)};
}

double thrust_variation(const RotorWindows& windows, const std::vector<Streams>& arcs, double lag) {
  Track sum(windows.count(), 0.0), mean_square;
  for (const Track& one : windows.thrust)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i];
  for (const Streams& arc : arcs)
    mean_square.insert(mean_square.end(), arc.mean_square.begin(), arc.mean_square.end());
  return mad_scale(sum) / (lag * static_cast<double>(windows.thrust.size()) * mean(mean_square));
}

}  // namespace ident
