// Noise levels: those to start from, those by the residuals, and the length of chunks that they ask for.
#include "ident/flight/fit/fit_noise.h"

#include <algorithm>
#include <cmath>

#include "ident/flight/conditioning/estimator_drift.h"
#include "ident/flight/smoother/input_error.h"

namespace ident {
namespace {

constexpr double kNoGust = 0.01;            // m/s^2: weaker gusts move no constant, whatever their axes
constexpr double kBeyondDoubtNoise = 10.0;  // decrease of -2 log likelihood
constexpr int kRetune = 3;
// Shortest chunks of a refinement and of a search, s: in a search, models that miss much would ask for the
// shortest and cost time only. Longest chunks, s, and how much longer those of a search are.
constexpr double kFinest = 0.03, kFinestSearch = 0.1, kLongest = 0.25, kInSearch = 2.0;

double rms_rate_of(const FlightRecord& record, int channel) {
  double sum = 0, n = 0;
  for (const FlightArc& arc : record.arcs) {
    double y0 = kNaN, t0 = 0;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const double y = arc.y[i * kChannels + static_cast<std::size_t>(channel)];
      if (!std::isfinite(y)) continue;
      if (!std::isfinite(y0)) y0 = y, t0 = arc.t[i];
      if (arc.t[i] - t0 < 0.05) continue;
      const double rate = (y - y0) / (arc.t[i] - t0);
      sum += rate * rate, n += 1, y0 = y, t0 = arc.t[i];
    }
  }
  return n > 0 ? std::sqrt(sum / n) : 0.0;
}

// Least white noise of a channel.
double least_noise(const FlightRecord& record, std::size_t channel) {
  return is_slowly_off(record, static_cast<int>(channel)) ? record.sigma[channel] : 1e-10;
}

}  // namespace

NoiseModel initial_noise(const FlightRecord& record) {
  NoiseModel noise;
  noise.sigma = record.sigma;
  double w = 0, v = 0;
  for (int k = 0; k < 3; ++k) {
    w = std::max(w, rms_rate_of(record, kGyro + k));
    v = std::max(v, rms_rate_of(record, kVelocity + k));
  }
  if (v == 0) v = 2.0;
  if (w == 0) w = 5.0;
  AirNoise air;
  air.w_dot.fill({0.2 * w, 0.1});
  air.v_dot.fill({0.1 * v, 0.5});
  noise.air.assign(static_cast<std::size_t>(record.logs), air);
  noise.slow = record.slow;
  noise.q_motor = record.signals.rotor_speeds ? 1.0 : 0.0;
  return noise;
}

double update_noise(FlightSmoother& smoother, int rounds) {
  const double change = smoother.retune(rounds);
  const Moments m = smoother.moments();
  NoiseModel noise = smoother.noise();
  double white = 0;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const double free = m.count[c] - m.leverage[c];
    if (m.count[c] < 8 || free < 0.02 * m.count[c]) continue;
    const double factor = std::clamp(m.square[c] / free, 0.05, 20.0);
    const double before = noise.sigma[c];
    noise.sigma[c] = std::max(before * std::sqrt(factor), least_noise(smoother.record(), c));
    white = std::max(white, std::abs(noise.sigma[c] / before - 1));
  }
  smoother.set_noise(noise);
  return std::max(0.3 * change, white);
}

bool choose_axes(FlightSmoother& smoother, const Eigen::VectorXd& u) {
  const StateLayout& layout = smoother.record().layout;
  double strongest = 0;
  for (const AirNoise& air : smoother.noise().air)
    for (const ColouredNoise& axis : air.v_dot) strongest = std::max(strongest, axis.sigma);
  if (layout.attitude < 0 || layout.v_dot < 0 || strongest < kNoGust) return true;
  const auto surprise_of = [&](const NoiseModel& noise) {
    smoother.set_noise(noise);
    smoother.settle(u, 1);
    smoother.linearize(u, true);
    smoother.accept();
    smoother.retune(kRetune);
    return smoother.surprise();
  };
  const NoiseModel world = smoother.noise();
  const std::vector<FlightState<double>> states = smoother.states();
  const double in_world = surprise_of(world);
  NoiseModel body = world;
  body.axes = GustAxes::body;
  const double in_body = surprise_of(body);
  if (in_body < in_world - kBeyondDoubtNoise) return true;
  smoother.set_noise(world);
  smoother.set_states(states);
  smoother.settle(u, 1);
  return in_world < in_body - kBeyondDoubtNoise;
}

double chunk_for(const FlightRecord& record, const NoiseModel& noise, bool fine) {
  // An acceleration that is constant over h seconds misses sqrt(2 s^2 h/tau) of a Gauss-Markov process, and
  // the velocity h/4 of that. This may reach a quarter of the noise of the mean of a chunk's rows, which
  // share the error. In a search chunks are twice as long: where a controller answers gusts, what they miss
  // then moves Jp and the motor lag by about one standard deviation; 3.5 times as long it was four to ten.
  double h = kLongest;
  const auto shorten = [&](std::size_t channel, const std::array<ColouredNoise, 3>& process) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (record.sigma[channel + i] == 1.0 || !(process[i].sigma > 0)) continue;  // 1: not measured
      const double ratio = noise.sigma[channel + i] * std::sqrt(process[i].tau / 2) / process[i].sigma;
      h = std::min(h, (fine ? 1.0 : kInSearch) * std::sqrt(ratio * std::sqrt(record.interval)));
    }
  };
  for (const AirNoise& air : noise.air) shorten(kGyro, air.w_dot), shorten(kVelocity, air.v_dot);
  const InputErrorProcess error = input_error_process(record, noise.axes);
  const auto as_noise = [&](Eigen::Index first) {
    std::array<ColouredNoise, 3> axes;
    for (std::size_t i = 0; i < 3; ++i)
      axes[i] = {std::sqrt(error.variance[first + static_cast<Eigen::Index>(i)]), error.time};
    return axes;
  };
  shorten(kGyro, as_noise(0)), shorten(kVelocity, as_noise(3));
  return std::clamp(h, std::max(4.0 * record.interval, fine ? kFinest : kFinestSearch), kLongest);
}

}  // namespace ident
