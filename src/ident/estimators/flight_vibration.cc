// Whether tones of rotors stand above what is beside them, how strong each rotor's are, and what is left
// without them.
#include "ident/estimators/flight_vibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ident/core/format_number.h"
#include "ident/core/parallel.h"
#include "ident/estimators/flight_tone_search.h"
#include "ident/estimators/flight_tone_sizes.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

// Of a window, at least; speeds that are simulated are off by more.
constexpr double kSeconds = 0.25, kSecondsSimulated = 0.125, kSamples = 40;
// Hz below which a tone is not told from motion, and its share of the variance of the noise that then
// matters.
constexpr double kFolded = 5.0, kMatters = 0.1;
constexpr double kAlone = 10.0;     // nats by which all rotors explain more than one
constexpr double kStandsOut = 3.0;  // times the amplitude of the usual rotor

struct Sensor {
  std::array<std::vector<double>, 3> FlightLog::*member;
  int group;
  bool logged;
  ToneWindows windows;
  std::vector<int> orders;  // of the tones it feels
};

// Every so many of many: enough to tell variances by.
void thin_out(std::vector<ToneWindow>& windows) {
  constexpr std::size_t kMost = 800;
  const std::size_t step = (windows.size() + kMost - 1) / kMost;
  for (std::size_t i = 1; step > 1 && i * step < windows.size(); ++i)
    windows[i] = std::move(windows[i * step]);
  if (step > 1) windows.resize((windows.size() + step - 1) / step);
}

// Takes the tones out of a sensor of the logs: windows that overlap by half, each fading out to its ends.
// Gives the share of its samples in which tones pass for motion, and which count as not sampled.
double take_out(const FlightRecord& record, std::vector<FlightLog>& logs, const Sensor& sensor,
                const ToneSizes& sizes, double seconds) {
  std::vector<std::vector<Eigen::Vector4d>> sums;  // [arc][row]: of weighted tones, and of weights
  for (const FlightArc& arc : record.arcs) sums.emplace_back(arc.rows(), Eigen::Vector4d::Zero());
  const Vector3d& sigma = sensor.windows.sigma;
  for (const double begin : {-0.5 * seconds, 0.0}) {
    const std::vector<ToneWindow> windows =
        tone_windows(record, sensor.group, seconds, begin, &sigma).windows;
    std::vector<MatrixXd> expected(windows.size());
    in_parallel(windows.size(), [&](std::size_t k) { expected[k] = sizes.expected(windows[k]); });
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const ToneWindow& w = windows[k];
      const MatrixXd& tones = expected[k];
      const bool lost = sizes.passes_for_motion(w, kFolded) > kMatters;
      const std::vector<double>& t = record.arcs[w.arc].t;
      const double from = t[w.rows.front()], span = t[w.rows.back()] - from;
      for (std::size_t i = 0; i < w.rows.size(); ++i) {
        const double weight = 0.02 + std::pow(std::sin(std::numbers::pi * (t[w.rows[i]] - from) / span), 2);
        Eigen::Vector4d& sum = sums[w.arc][w.rows[i]];
        sum.head<3>() += weight * tones.row(static_cast<Index>(i)).transpose(), sum[3] += weight;
        if (lost) sum[0] = sum[1] = sum[2] = kNaN;
      }
    }
  }
  double samples = 0, left_out = 0;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    FlightLog& log = logs[static_cast<std::size_t>(arc.log)];
    const auto first =
        static_cast<std::size_t>(std::ranges::lower_bound(log.t, arc.t.front()) - log.t.begin());
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const Eigen::Vector4d& sum = sums[a][i];
      if (!(sum[3] > 0)) continue;
      samples += 1, left_out += std::isnan(sum[0]);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<Index>(c);
        (log.*sensor.member)[c][first + i] -= sum[axis] / sum[3] * sigma[axis];
      }
    }
  }
  return samples > 0 ? left_out / samples : 0.0;
}

// Amplitude of the rotor in question over that of the usual one of the others.
double over_the_usual(const std::vector<double>& of_rotor, std::size_t rotor) {
  std::vector<double> others(of_rotor);
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(rotor));
  return of_rotor[rotor] / std::max(median(others), 1e-3);
}

}  // namespace

int Vibration::stands_out() const {
  if (of_rotor.size() < 2) return 0;
  const auto most = static_cast<std::size_t>(std::ranges::max_element(of_rotor) - of_rotor.begin());
  return one_alone || over_the_usual(of_rotor, most) > kStandsOut ? static_cast<int>(most) + 1 : 0;
}

std::string Vibration::what_stands_out() const {
  const int rotor = stands_out();
  if (rotor == 0) return "";
  const double times = over_the_usual(of_rotor, static_cast<std::size_t>(rotor - 1));
  return times > kStandsOut
             ? fmt::format(
                   "the propeller of rotor {}, out of balance, is felt {:.0f} times as much as the others",
                   rotor, times)
             : "one propeller is out of balance, or all are: these logs do not tell them apart";
}

std::vector<FlightLog> without_vibration(const FlightRecord& record, std::span<const FlightLog> logs,
                                         Vibration& vibration, std::vector<Warning>& warnings) {
  const Signals& s = record.signals;
  if (!s.commands && !s.rotor_speeds) return {};
  std::array<Sensor, 2> sensors = {
      {{&FlightLog::w_B, kGyro, s.rates, {}, {}}, {&FlightLog::f_B, kForce, s.force, {}, {}}}};
  std::array<bool, 2> uneven{};
  in_parallel(sensors.size(), [&](std::size_t k) {
    uneven[k] = sensors[k].logged && has_uneven_spectrum(record, sensors[k].group);
  });
  if (!uneven[0] && !uneven[1]) return {};
  const TurningRotors rotors(record);
  const double seconds =
      std::max(rotors.measured() ? kSeconds : kSecondsSimulated, kSamples * record.interval);
  in_parallel(sensors.size(), [&](std::size_t k) {
    if (!sensors[k].logged) return;
    sensors[k].windows = tone_windows(record, sensors[k].group, seconds);
    thin_out(sensors[k].windows.windows);
  });
  const double scale =
      rotors.measured() ? 1.0 : likeliest_scale(rotors, {&sensors[0].windows, &sensors[1].windows}, seconds);
  bool found = false;
  for (Sensor& sensor : sensors) {
    TonesFound tones = tones_that_stand_out(rotors, sensor.windows, scale);
    found |= !tones.beyond_doubt.empty(), sensor.orders = std::move(tones.likely);
  }
  if (!found) return {};

  std::vector<FlightLog> out(logs.begin(), logs.end());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(rotors.count()), alone = square;
  double together = 0, left_out = 0;
  for (const Sensor& sensor : sensors) {
    if (sensor.orders.empty()) continue;
    const ToneSizes sizes(rotors, sensor.windows, sensor.orders, scale);
    together += sizes.log_likelihood();
    for (Index k = 0; k < sizes.variance().rows(); ++k)
      square[k % rotors.count()] += sizes.variance().row(k).sum();
    const Vector3d of_axis = sizes.variance().colwise().sum();
    (sensor.group == kGyro ? vibration.rates : vibration.force) =
        std::sqrt(of_axis.dot(sensor.windows.sigma.cwiseAbs2()) / 3);
    for (int n = 0; n < rotors.count(); ++n) alone[n] += sizes.log_likelihood_of(n);
    left_out = std::max(left_out, take_out(record, out, sensor, sizes, seconds));
  }
  vibration.speeds = scale;
  for (const double x : square) vibration.of_rotor.push_back(std::sqrt(x));
  vibration.one_alone = together - alone.maxCoeff() < kAlone;
  std::string lost;
  if (constexpr double kWorthTelling = 0.005; left_out > kWorthTelling)
    lost = fmt::format("; where they pass for motion, in {:.0f} % of the samples, nothing counts",
                       100 * std::max(left_out, 0.01));
  warnings.push_back(
      {"vibration",
       fmt::format(
           "rates and specific force show the rotors turn, by {} rad/s and {} m/s^2, which is taken "
           "out{}; {}",
           format_number(vibration.rates, 2), format_number(vibration.force, 2), lost,
           vibration.stands_out() > 0 ? vibration.what_stands_out() : "log what went through a filter")});
  return out;
}

}  // namespace ident
