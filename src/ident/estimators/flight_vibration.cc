// Whether tones of rotors stand above what is beside them, how strong each rotor's are, and what is left
// without them.
#include "ident/estimators/flight_vibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "ident/core/format_number.h"
#include "ident/core/parallel.h"
#include "ident/estimators/flight_tone_sizes.h"
#include "ident/estimators/statistics.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

// Of a window, at least; speeds that are simulated are off by more.
constexpr double kSeconds = 0.25, kSecondsSimulated = 0.125, kSamples = 40;
constexpr double kBeyondDoubt = 6.0;  // standard deviations,
constexpr double kLikely = 3.5;       // and where another tone is there beyond doubt
// By which simulated speeds may be off, and steps in which that is looked for.
constexpr double kFarthest = 0.1, kStep = 0.005, kFineStep = 0.0005;
constexpr double kAlone = 10.0;     // nats by which all rotors explain more than one
constexpr double kStandsOut = 3.0;  // times the amplitude of the usual rotor

// Multiples of the turns that sensors feel: balance, and blades that pass.
constexpr std::array kToneOrders = {1, 2, 3};

using Components = std::array<std::vector<double>, 3>;

struct Sensor {
  Components FlightLog::*member;
  int group;
  bool logged;
  ToneWindows windows;
  std::vector<int> orders;  // of the tones it feels
};

// By how much tones stand above what is beside them, and its standard deviation.
struct Above {
  double power = 0.0, std = 0.0;
  double all = 0.0;  // with what is beside them

  bool beyond(double deviations) const { return power > deviations * std; }
};

// Of each order. Beside one tone there may be another: what is usual beside it counts.
std::array<Above, kToneOrders.size()> above_its_sides(const TurningRotors& rotors, const ToneWindows& sensor,
                                                      double scale) {
  static constexpr std::array kSides = {0.0, -4.0, -2.5, -1.5, 1.5, 2.5, 4.0};  // widths of a window's line
  using Powers = std::array<double, kSides.size()>;
  std::array<std::vector<Powers>, kToneOrders.size()> found;
  for (const ToneWindow& w : sensor.windows) {
    const Eigen::ArrayXXcd turned = rotors.turned(w, scale);
    const Eigen::VectorXcd sizes = rotors.sizes(w).cast<std::complex<double>>();
    Eigen::MatrixXcd y(w.y.rows(), 3);
    for (Index axis = 0; axis < 3; ++axis)
      y.col(axis) = w.weighted(w.y.col(axis), axis).cast<std::complex<double>>();
    Eigen::ArrayXXcd aside(w.y.rows(), static_cast<Index>(kSides.size()));
    for (Index i = 0; i < aside.rows(); ++i)
      for (std::size_t side = 0; side < kSides.size(); ++side)
        aside(i, static_cast<Index>(side)) =
            std::polar(1.0, 2 * std::numbers::pi * kSides[side] * static_cast<double>(i) /
                                static_cast<double>(aside.rows()));
    for (std::size_t k = 0; k < kToneOrders.size(); ++k) {
      const Eigen::ArrayXXcd tone = turned.pow(kToneOrders[k]);
      Powers& powers = found[k].emplace_back();
      for (std::size_t side = 0; side < kSides.size(); ++side)
        powers[side] = (sizes.asDiagonal() *
                        ((tone.colwise() * aside.col(static_cast<Index>(side))).matrix().adjoint() * y))
                           .squaredNorm();
    }
  }
  std::array<Above, kToneOrders.size()> out;
  for (std::size_t k = 0; k < found.size(); ++k) {
    Powers sums{};
    for (const Powers& powers : found[k])
      for (std::size_t side = 0; side < kSides.size(); ++side) sums[side] += powers[side];
    std::vector<double> beside(sums.begin() + 1, sums.end());
    const double usual = median(beside), n = static_cast<double>(found[k].size());
    out[k].all = sums[0], out[k].power = sums[0] - usual;
    for (const Powers& powers : found[k]) out[k].std += std::pow(powers[0] - usual / n - out[k].power / n, 2);
    out[k].std = std::sqrt(out[k].std);
  }
  return out;
}

// What gives the most, of scales about 1.
double likeliest_scale(const std::function<double(double)>& power) {
  double best = 1.0, half = kFarthest;
  for (const double step : {kStep, kFineStep}) {
    const double first = best - half;
    std::vector<double> found(static_cast<std::size_t>(2 * std::round(half / step) + 1));
    in_parallel(found.size(),
                [&](std::size_t i) { found[i] = power(first + static_cast<double>(i) * step); });
    best = first + static_cast<double>(std::ranges::max_element(found) - found.begin()) * step;
    half = step;
  }
  return best;
}

// Takes the tones out of a sensor of the logs: windows that overlap by half, each fading out to its ends.
void take_out(const FlightRecord& record, std::vector<FlightLog>& logs, const Sensor& sensor,
              const ToneSizes& sizes, double seconds) {
  std::vector<std::vector<Eigen::Vector4d>> sums;  // [arc][row]: of weighted tones, and of weights
  for (const FlightArc& arc : record.arcs) sums.emplace_back(arc.rows(), Eigen::Vector4d::Zero());
  const Vector3d& sigma = sensor.windows.sigma;
  for (const double begin : {-0.5 * seconds, 0.0}) {
    ToneWindows shifted = tone_windows(record, sensor.group, seconds, begin);
    for (ToneWindow& w : shifted.windows) {
      w.y *= shifted.sigma.cwiseQuotient(sigma).asDiagonal();
      const MatrixXd tones = sizes.expected(w);
      const std::vector<double>& t = record.arcs[w.arc].t;
      const double from = t[w.rows.front()], span = t[w.rows.back()] - from;
      for (std::size_t i = 0; i < w.rows.size(); ++i) {
        const double weight = 0.02 + std::pow(std::sin(std::numbers::pi * (t[w.rows[i]] - from) / span), 2);
        Eigen::Vector4d& sum = sums[w.arc][w.rows[i]];
        sum.head<3>() += weight * tones.row(static_cast<Index>(i)).transpose(), sum[3] += weight;
      }
    }
  }
  for (std::size_t a = 0; a < record.arcs.size(); ++a) {
    const FlightArc& arc = record.arcs[a];
    FlightLog& log = logs[static_cast<std::size_t>(arc.log)];
    const auto first =
        static_cast<std::size_t>(std::ranges::lower_bound(log.t, arc.t.front()) - log.t.begin());
    for (std::size_t i = 0; i < arc.rows(); ++i)
      for (std::size_t c = 0; c < 3 && sums[a][i][3] > 0; ++c) {
        const auto axis = static_cast<Index>(c);
        (log.*sensor.member)[c][first + i] -= sums[a][i][axis] / sums[a][i][3] * sigma[axis];
      }
  }
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
    if (sensors[k].logged) sensors[k].windows = tone_windows(record, sensors[k].group, seconds);
  });
  const auto power = [&](double scale) {
    double sum = 0;
    for (const Sensor& sensor : sensors)
      for (const Above& order : above_its_sides(rotors, sensor.windows, scale)) sum += order.all;
    return sum;
  };
  const double scale = rotors.measured() ? 1.0 : likeliest_scale(power);
  bool found = false;
  for (Sensor& sensor : sensors) {
    const auto above = above_its_sides(rotors, sensor.windows, scale);
    for (std::size_t k = 0; k < above.size(); ++k) {
      found |= above[k].beyond(kBeyondDoubt);
      if (above[k].beyond(kLikely)) sensor.orders.push_back(kToneOrders[k]);
    }
  }
  if (!found) return {};

  std::vector<FlightLog> out(logs.begin(), logs.end());
  std::vector<int> all(static_cast<std::size_t>(rotors.count()));
  std::iota(all.begin(), all.end(), 0);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(rotors.count()), alone = square;
  double together = 0;
  for (const Sensor& sensor : sensors) {
    if (sensor.orders.empty()) continue;
    const ToneSizes sizes(rotors, sensor.windows, all, sensor.orders, scale);
    together += sizes.log_likelihood();
    for (Index k = 0; k < sizes.variance().rows(); ++k)
      square[k % rotors.count()] += sizes.variance().row(k).sum();
    const Vector3d of_axis = sizes.variance().colwise().sum();
    (sensor.group == kGyro ? vibration.rates : vibration.force) =
        std::sqrt(of_axis.dot(sensor.windows.sigma.cwiseAbs2()) / 3);
    for (int n = 0; n < rotors.count(); ++n)
      alone[n] += ToneSizes(rotors, sensor.windows, {n}, sensor.orders, scale).log_likelihood();
    take_out(record, out, sensor, sizes, seconds);
  }
  vibration.speeds = scale;
  for (const double x : square) vibration.of_rotor.push_back(std::sqrt(x));
  vibration.one_alone = together - alone.maxCoeff() < kAlone;
  warnings.push_back(
      {"vibration",
       fmt::format(
           "rates and specific force show the rotors turn, by {} rad/s and {} m/s^2: taken out as far "
           "as it can be told from flight; {}",
           format_number(vibration.rates, 2), format_number(vibration.force, 2),
           vibration.stands_out() > 0 ? vibration.what_stands_out() : "log what went through a filter")});
  return out;
}

}  // namespace ident
