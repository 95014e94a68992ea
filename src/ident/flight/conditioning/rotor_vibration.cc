// Whether tones of rotors stand above what is beside them, how strong each rotor's are, and what is left
// without them.
#include "ident/flight/conditioning/rotor_vibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "ident/core/format_number.h"
#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/flight/conditioning/commanded_motion.h"
#include "ident/flight/conditioning/tone_amplitudes.h"
#include "ident/flight/conditioning/tone_search.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

// Of a window, at least; speeds that are simulated are off by more.
constexpr double kSeconds = 0.25, kSecondsSimulated = 0.125;
// Hz below which a tone is not told from motion, and its share of the variance of the noise that then
// matters.
constexpr double kFolded = 5.0, kMatters = 0.1;
constexpr double kAlone = 10.0;  // nats by which all rotors explain more than one, and one more than another
constexpr double kStandsOut = 3.0;  // times the amplitude of the usual rotor

struct ShakenSensor {
  std::array<std::vector<double>, 3> FlightLog::*member;
  int group;
  bool logged;
  ToneWindows windows;
  std::vector<int> orders;  // of the tones it feels
  bool passed_on;           // to the motors
};

// Every so many of many: enough to tell variances by.
void thin_out(std::vector<ToneWindow>& windows) {
  constexpr std::size_t kMost = 800;
  const std::size_t step = (windows.size() + kMost - 1) / kMost;
  for (std::size_t i = 1; step > 1 && i * step < windows.size(); ++i)
    windows[i] = std::move(windows[i * step]);
  if (step > 1) windows.resize((windows.size() + step - 1) / step);
}

// Tones of a sensor by [arc][row]: weighted sums, NaN where they pass for motion, and weights. Windows
// overlap by half, each fading out to its ends.
std::vector<std::vector<Eigen::Vector4d>> tones_by_row(const FlightRecord& record, const ShakenSensor& sensor,
                                                       const ToneSizes& sizes) {
  std::vector<std::vector<Eigen::Vector4d>> sums;
  for (const FlightArc& arc : record.arcs) sums.emplace_back(arc.rows(), Eigen::Vector4d::Zero());
  for (const double begin : {-0.5, 0.0}) {
    const std::vector<ToneWindow> windows =
        tone_windows(record, sensor.group, sensor.windows.seconds, begin, &sensor.windows.sigma).windows;
    std::vector<MatrixXd> expected(windows.size());
    in_parallel(windows.size(), [&](std::size_t k) { expected[k] = sizes.expected(windows[k]); });
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const ToneWindow& w = windows[k];
      const bool lost = sizes.passes_for_motion(w, kFolded) > kMatters;
      const std::vector<double>& t = record.arcs[w.arc].t;
      const double from = t[w.rows.front()], span = t[w.rows.back()] - from;
      for (std::size_t i = 0; i < w.rows.size(); ++i) {
        const double weight = 0.02 + std::pow(std::sin(std::numbers::pi * (t[w.rows[i]] - from) / span), 2);
        Eigen::Vector4d& sum = sums[w.arc][w.rows[i]];
        sum.head<3>() += weight * expected[k].row(static_cast<Index>(i)).transpose(), sum[3] += weight;
        if (lost) sum.head<3>().setConstant(kNaN);
      }
    }
  }
  return sums;
}

// Takes the tones out of a sensor of the logs, and gives the share of its samples that then count as none.
double take_out(const FlightRecord& record, std::vector<FlightLog>& logs, const ShakenSensor& sensor,
                const ToneSizes& sizes) {
  const auto tones = tones_by_row(record, sensor, sizes);
  double samples = 0, left_out = 0;
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    FlightLog& log = logs[static_cast<std::size_t>(arc.log)];
    const auto first =
        static_cast<std::size_t>(std::ranges::lower_bound(log.t, arc.t.front()) - log.t.begin());
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const Eigen::Vector4d& sum = tones[a][i];
      if (!(sum[3] > 0)) continue;
      samples += 1, left_out += std::isnan(sum[0]);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<Index>(c);
        (log.*sensor.member)[c][first + i] -= sum[axis] / sum[3] * sensor.windows.sigma[axis];
      }
    }
  }
  return samples > 0 ? left_out / samples : 0.0;
}

// Looks for tones in both sensors; gives how much faster rotors turn than simulated, NaN where there are
// none.
double find_tones(const FlightRecord& record, const TurningRotors& rotors,
                  std::array<ShakenSensor, 2>& sensors) {
  in_parallel(sensors.size(), [&](std::size_t k) {
    if (!sensors[k].logged) return;
    sensors[k].windows =
        tone_windows(record, sensors[k].group, rotors.measured() ? kSeconds : kSecondsSimulated);
    thin_out(sensors[k].windows.windows);
  });
  const double scale =
      rotors.measured() ? 1.0 : likeliest_scale(rotors, {&sensors[0].windows, &sensors[1].windows});
  if (std::isnan(scale)) return kNaN;
  bool found = false;
  for (ShakenSensor& sensor : sensors) {
    TonesFound tones = tones_that_stand_out(rotors, sensor.windows,
                                            commanded_in(record, sensor.group, sensor.windows), scale);
    found |= !tones.beyond_doubt.empty(), sensor.orders = std::move(tones.likely);
    sensor.passed_on = tones.passed_on;
  }
  return found ? scale : kNaN;
}

// Takes the tones out of the logs.
Vibration take_out_all(const FlightRecord& record, std::vector<FlightLog>& logs, const TurningRotors& rotors,
                       const std::array<ShakenSensor, 2>& sensors, double scale) {
  Vibration out;
  out.speeds = scale;
  std::vector<double> alone(static_cast<std::size_t>(rotors.count()), 0.0);
  out.of_rotor = alone;
  double together = 0;
  for (const ShakenSensor& sensor : sensors) {
    if (sensor.orders.empty()) continue;
    out.passed_on |= sensor.passed_on;
    const ToneSizes sizes(rotors, sensor.windows, sensor.orders, scale);
    together += sizes.log_likelihood();
    const Vector3d of_axis = sizes.variance().colwise().sum(), per_noise = sizes.noise().cwiseInverse() / 3;
    (sensor.group == kGyro ? out.rates : out.force) =
        std::sqrt(of_axis.dot(sensor.windows.sigma.cwiseAbs2()) / 3);
    for (std::size_t n = 0; n < alone.size(); ++n) {
      const auto rotor = static_cast<Index>(n);
      double square = 0;
      for (Index k = rotor; k < sizes.variance().rows(); k += rotors.count())
        square += sizes.variance().row(k).dot(per_noise);
      out.of_rotor[n] = std::max(out.of_rotor[n], std::sqrt(square));
      alone[n] += sizes.log_likelihood_of(static_cast<int>(n));
    }
    out.left_out = std::max(out.left_out, take_out(record, logs, sensor, sizes));
  }
  std::ranges::sort(alone, std::greater<>());
  out.one_alone = alone.size() > 1 && together - alone[0] < kAlone;
  out.told_apart = alone.size() > 1 && alone[0] - alone[1] > kAlone;
  return out;
}

std::string told(const Vibration& vibration) {
  const auto amount = [](double size, const char* of, const char* unit) {
    return fmt::format("{} by {} {}", of, format_number(size, 2), unit);
  };
  std::vector<std::string> felt;
  if (vibration.rates > 0) felt.push_back(amount(vibration.rates, "the rates", "rad/s"));
  if (vibration.force > 0) felt.push_back(amount(vibration.force, "the specific force", "m/s^2"));
  std::string lost;
  if (constexpr double kWorthTelling = 0.005; vibration.left_out > kWorthTelling)
    lost = fmt::format(" Where a tone passes for motion, in {:.0f} % of the samples, the sample is not used.",
                       100 * std::max(vibration.left_out, 0.01));
  if (vibration.passed_on)
    lost +=
        " The controller passes them on to the motors, so omega_m, zeta_m, dead_time and Jp are not "
        "identifiable.";
  return fmt::format("Tones of the turning rotors move {}. They are taken out.{} {}.",
                     fmt::join(felt, " and "), lost,
                     vibration.unbalanced() ? "Balance the propellers: " + vibration.what_is_unbalanced()
                                            : "Mount the sensor softer, or log it behind a filter");
}

// Amplitude of the rotor in question over that of the usual one of the others, as far as these are told.
double over_the_usual(const std::vector<double>& of_rotor, std::size_t rotor) {
  constexpr double kTold = 0.02;  // of the larger one
  std::vector<double> others(of_rotor);
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(rotor));
  return of_rotor[rotor] / std::max(median(others), kTold * of_rotor[rotor]);
}

}  // namespace

int Vibration::stands_out() const {
  if (of_rotor.size() < 2 || (one_alone && !told_apart)) return 0;
  const auto most = static_cast<std::size_t>(std::ranges::max_element(of_rotor) - of_rotor.begin());
  return over_the_usual(of_rotor, most) > kStandsOut ? static_cast<int>(most) + 1 : 0;
}

std::string Vibration::what_is_unbalanced() const {
  if (const int rotor = stands_out(); rotor > 0)
    return fmt::format(
        "the propeller of rotor {}, out of balance, is felt {:.0f} times as much as the others", rotor,
        over_the_usual(of_rotor, static_cast<std::size_t>(rotor - 1)));
  return one_alone ? "one propeller is out of balance, or all are: these logs do not tell them apart" : "";
}

std::vector<FlightLog> without_vibration(const FlightRecord& record, std::span<const FlightLog> logs,
                                         Vibration& vibration, std::vector<Warning>& warnings) {
  vibration = {};
  const Signals& s = record.signals;
  if (!s.commands && !s.rotor_speeds) return {};
  std::array<ShakenSensor, 2> sensors = {
      {{&FlightLog::w_B, kGyro, s.rates, {}, {}, false}, {&FlightLog::f_B, kForce, s.force, {}, {}, false}}};
  std::array<bool, 6> uneven{};
  in_parallel(uneven.size(), [&](std::size_t k) {
    const ShakenSensor& sensor = sensors[k / 3];
    uneven[k] = sensor.logged && has_uneven_spectrum(record, sensor.group + static_cast<int>(k % 3));
  });
  if (std::ranges::none_of(uneven, std::identity())) return {};
  const TurningRotors rotors(record);
  const double scale = find_tones(record, rotors, sensors);
  if (std::isnan(scale)) return {};
  std::vector<FlightLog> out(logs.begin(), logs.end());
  vibration = take_out_all(record, out, rotors, sensors, scale);
  warnings.push_back({"vibration", told(vibration)});
  return out;
}

}  // namespace ident
