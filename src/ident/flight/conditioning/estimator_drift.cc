// One sensor against the integral of another over short and long lags: white noise of the one is the same in
// both, that of the other grows by its own density, and what grows faster is a slow error.
#include "ident/flight/conditioning/estimator_drift.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "ident/core/parallel.h"
#include "ident/flight/conditioning/dead_reckoning_error.h"

namespace ident {
namespace {

using Eigen::Array3d;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Windows at both ends of a lag, and the lags, in bins.
constexpr std::size_t kMean = 4, kShort = 5, kLong = 20;
// What is beyond chance, in deviations (of attitude, of velocity and position), and beyond what the
// integrated sensor is known to do: noise is not quite white.
constexpr double kBeyondChance = 2.5, kBeyondDoubt = 4.0, kBeyondNoise = 1.3;
constexpr double kTime = 3.0;         // s, to start from
constexpr double kLeastShare = 0.05;  // of what all axes show, to start from

// Mean square by axis of what is left of a stray over a lag once nuisances are taken out.
struct MeanSquare {
  Array3d sum = Array3d::Zero();
  double degrees = 0;  // of each axis

  void add(const Stray& of, std::size_t lag) {
    struct Window {
      Vector3d stray;
      Stray::Slopes G;
    };
    const auto mean = [&](std::size_t first) {
      Stray::Bin all{0.0, Vector3d::Zero(), Stray::Slopes::Zero(3, of.nuisances)};
      for (std::size_t k = first; k < first + kMean; ++k)
        all.count += of.bins[k].count, all.stray += of.bins[k].stray, all.G += of.bins[k].G;
      return all;
    };
    std::vector<Window> windows;
    for (std::size_t k = 0; k + lag + kMean <= of.bins.size(); k += lag) {
      const Stray::Bin a = mean(k), b = mean(k + lag);
      if (a.count > 0 && b.count > 0)
        windows.push_back({b.stray / b.count - a.stray / a.count, b.G / b.count - a.G / a.count});
    }
    const double n = static_cast<double>(windows.size()), per_axis = static_cast<double>(of.nuisances) / 3;
    if (n < 2 * per_axis) return;
    MatrixXd H = MatrixXd::Zero(of.nuisances, of.nuisances);
    VectorXd g = VectorXd::Zero(of.nuisances);
    for (const Window& w : windows) H += w.G.transpose() * w.G, g += w.G.transpose() * w.stray;
    const VectorXd s = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd scaled = s.asDiagonal() * H * s.asDiagonal();
    scaled.diagonal().array() += 1e-10;
    const VectorXd x = s.asDiagonal() * scaled.ldlt().solve(s.asDiagonal() * g);
    for (const Window& w : windows) sum += (w.stray - w.G * x).array().square();
    degrees += n - per_axis;
  }
  Array3d mean() const { return sum / degrees; }
  Array3d variance() const { return 2 * mean().square() / degrees; }
};

// Density of the white noise of a group, in its unit squared times s.
Array3d density_of(const FlightRecord& record, int group) {
  double samples = 0;
  for (const FlightArc& arc : record.arcs)
    for (std::size_t i = 0; i < arc.rows(); ++i) samples += std::isfinite(group_at(arc, i, group)[0]);
  const auto g = static_cast<std::size_t>(group);
  const Array3d sigma(record.sigma[g], record.sigma[g + 1], record.sigma[g + 2]);
  return sigma.square() * record.duration / std::max(samples, 1.0);
}

// What white noise e of the attitude adds to its stray, rad^2/s by axis. The stray is summed up in the body's
// own frame, where errors of samples next to each other cancel but for w dt x e and e x e'/2: by log of
// exp(-e) exp(w dt) exp(e') to second order.
Array3d summed_noise(const FlightRecord& record) {
  Array3d square = Array3d::Zero();
  double rows = 0;
  for (const FlightArc& arc : record.arcs)
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const Vector3d w = group_at(arc, i, kGyro);
      if (w.allFinite()) square += w.array().square(), rows += 1;
    }
  const Array3d w2 = square / std::max(rows, 1.0), density = density_of(record, kAttitude);
  const Array3d e2(std::pow(record.sigma[kAttitude], 2), std::pow(record.sigma[kAttitude + 1], 2),
                   std::pow(record.sigma[kAttitude + 2], 2));
  const double dt = density[0] / e2[0];  // between samples
  Array3d out;
  for (Index x = 0; x < 3; ++x) {
    const Index y = (x + 1) % 3, z = (x + 2) % 3;
    out[x] = w2[y] * density[z] + w2[z] * density[y] + e2[y] * e2[z] / (2 * dt);
  }
  return out;
}

// Whether white noise shows in what a group changes by from row to row: by itself second differences next to
// each other are correlated by -2/3. Without, exact data, all sensors agree with each other's integral.
bool is_noisy(const FlightRecord& record, int group) {
  constexpr double kNoisy = -0.1;
  double square = 0, next = 0;
  for (const FlightArc& arc : record.arcs) {
    Vector3d a = Vector3d::Constant(kNaN), b = a, last = a;
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      const Vector3d y = group_at(arc, i, group);
      if (!y.allFinite()) continue;
      const Vector3d second = y - 2 * b + a;
      if (last.allFinite()) square += last.squaredNorm(), next += last.dot(second);
      last = second, a = b, b = y;
    }
  }
  return next < kNoisy * square;
}

// Whether samples follow the integral of the other sensor closer than its own noise would let them: they are
// that integral, noise and all.
bool are_integrated(const std::vector<Stray>& strays, const FlightRecord& record, int integrated) {
  constexpr double kShare = 0.5, kFewDrift = 100;
  if (!is_noisy(record, integrated)) return false;
  double steps = 0, square = 0, seconds = 0;
  for (const Stray& one : strays) steps += one.steps, square += one.square, seconds += one.seconds;
  return steps > kFewDrift && square < kShare * density_of(record, integrated).sum() * seconds;
}

// Of each arc, of what can be integrated.
std::array<std::vector<Stray>, kShownGroups> all_strays(const FlightRecord& record) {
  const Signals& logged = record.signals;
  const double gravity = record.vehicle->g;
  std::array<std::vector<Stray>, kShownGroups> all;
  in_parallel(kShownGroups, [&](std::size_t group) {
    for (const FlightArc& arc : record.arcs) {
      if (group == kShownAttitude && logged.rates) all[group].push_back(stray_of_attitude(arc));
      if (group == kShownVelocity && logged.force && logged.velocity)
        all[group].push_back(stray_of_velocity(arc, gravity));
      if (group == kShownPosition && logged.velocity && logged.position)
        all[group].push_back(stray_of_position(arc));
    }
  });
  return all;
}

// What grows beyond `noise`, the density that is known, as a process; none unless beyond doubt.
std::array<ColouredNoise, 3> beyond(const std::vector<Stray>& strays, const Array3d& noise,
                                    double deviations) {
  MeanSquare near, far;
  for (const Stray& one : strays) near.add(one, kShort), far.add(one, kLong);
  if (!(far.degrees > 0) || !(near.degrees > 0)) return {};
  constexpr double kBetween = static_cast<double>(kLong - kShort) * kStrayBin;
  const Array3d grown = (far.mean() - near.mean()) / kBetween;
  const double chance = std::sqrt((far.variance() + near.variance()).sum()) / kBetween;
  const double more = (grown - noise).sum();
  if (!(more > deviations * chance) || !(grown.sum() > kBeyondNoise * noise.sum())) return {};
  std::array<ColouredNoise, 3> error;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Index>(k);
    const double density = std::max(grown[axis] - noise[axis], kLeastShare * more);
    error[k] = {std::sqrt(density * kTime / 2), kTime};
  }
  return error;
}

// What an error gains about its worst axis in a second.
double after_a_second(const std::array<ColouredNoise, 3>& error) {
  double most = 0;
  for (const ColouredNoise& axis : error)
    most = std::max(most, axis.sigma * std::sqrt(2 * (1 - axis.carried(1.0))));
  return most;
}

// Within a second or so an estimator shows little but the integral of its rates and forces, and with it their
// very noise, which would be seen twice and pass for gusts. So much white noise that for so long rates and
// forces tell more.
void hide_what_is_integrated(FlightRecord& record) {
  constexpr double kLeans = 1.0;  // s, in which an estimator begins to lean on what else it knows
  const auto found = [&](ShownGroup group) { return record.slow[group][0].sigma > 0; };
  const auto hide = [&](int group, double density) {  // of the error after kLeans
    for (std::size_t k = 0; k < 3; ++k) {
      double& sigma = record.sigma[static_cast<std::size_t>(group) + k];
      const double per_sample = density_of(record, group)[static_cast<Index>(k)] / (sigma * sigma);
      sigma = std::max(sigma, std::sqrt(density / per_sample));
    }
  };
  const double of_rates = density_of(record, kGyro).mean(), of_force = density_of(record, kForce).mean(),
               of_velocity = density_of(record, kVelocity).mean();
  constexpr double kTwice = kLeans * kLeans;
  if (found(kShownAttitude)) hide(kAttitude, of_rates * kTwice);
  if (found(kShownVelocity)) hide(kVelocity, of_force * kTwice);
  if (found(kShownPosition))
    hide(kPosition, found(kShownVelocity) ? of_force * kTwice * kTwice : of_velocity * kTwice);
}

}  // namespace

FoundSlowErrors slow_errors(const FlightRecord& record) {
  const Signals& logged = record.signals;
  const double gravity = record.vehicle->g;
  FoundSlowErrors out;
  SlowErrors& found = out.errors;
  bool& estimated = out.of_estimator;
  if (!logged.attitude) return out;
  const Array3d of_rates = density_of(record, kGyro), of_force = density_of(record, kForce);
  const auto strays = all_strays(record);
  if (logged.rates) {
    const std::vector<Stray>& all = strays[kShownAttitude];
    found[kShownAttitude] = beyond(all, of_rates + summed_noise(record), kBeyondChance);
    estimated = are_integrated(all, record, kGyro);
  }
  if (logged.force && logged.velocity) {
    // An attitude that drifts lets gravity in; by how much more than its density says over a second, its time
    // is not known.
    constexpr double kOfDrift = 3.0;
    Array3d tilt = gravity * gravity * density_of(record, kAttitude);
    for (const ColouredNoise& axis : found[kShownAttitude])
      tilt += kOfDrift / 3 * std::pow(gravity * axis.sigma, 2);
    const std::vector<Stray>& all = strays[kShownVelocity];
    found[kShownVelocity] = beyond(all, Array3d(of_force.mean() + tilt.mean()), kBeyondDoubt);
    estimated = estimated || are_integrated(all, record, kForce);
  }
  if (logged.velocity && logged.position)
    found[kShownPosition] = beyond(strays[kShownPosition], density_of(record, kVelocity), kBeyondDoubt);
  // An autopilot's estimator shows all of it.
  const auto strays_by = [&](ShownGroup group) { return found[group][0].sigma > 0; };
  estimated =
      estimated || strays_by(kShownVelocity) || (strays_by(kShownAttitude) && strays_by(kShownPosition));
  if (!estimated) return out;
  const auto at_least = [&](ShownGroup group, const Array3d& density) {
    for (std::size_t k = 0; k < 3; ++k) {
      ColouredNoise& axis = found[group][k];
      axis = {std::max(axis.sigma, std::sqrt(density[static_cast<Index>(k)] * kTime / 2)), kTime};
    }
  };
  if (logged.rates) at_least(kShownAttitude, of_rates);
  if (logged.force && logged.velocity) at_least(kShownVelocity, of_force);
  if (logged.force && logged.position) at_least(kShownPosition, of_force);
  return out;
}

bool is_slowly_off(const FlightRecord& record, int channel) {
  const int group = (channel - kAttitude) / 3;
  return channel >= kAttitude && channel < kRotorChannel && record.layout.shown_error[group] >= 0;
}

void add_slow_errors(FlightRecord& record) {
  const FoundSlowErrors seen = slow_errors(record);
  record.slow = seen.errors;
  if (seen.of_estimator) hide_what_is_integrated(record);
  static constexpr std::array kWhat = {"attitude", "velocity", "position"};
  static constexpr std::array kUnit = {"rad", "m/s", "m"};
  std::string told;
  for (std::size_t g = 0; g < kShownGroups; ++g) {
    const double grows = after_a_second(record.slow[g]);
    if (!(grows > 0)) continue;
    record.layout.shown_error[g] = std::exchange(record.layout.size, record.layout.size + 3);
    told += fmt::format("{}{} by {:.2g} {}", told.empty() ? "" : ", ", kWhat[g], grows, kUnit[g]);
  }
  if (told.empty()) return;
  const char* const so =
      seen.of_estimator
          ? "They come from an estimator, so within a second they count for no more than those sensors."
          : "A slow error of each is estimated with the flight.";
  record.warnings.push_back(
      {"slow_errors",
       fmt::format(
           "Logged states drift from the integral of the rates, forces or velocities, in a second {}. {}",
           told, so)});
}

}  // namespace ident
