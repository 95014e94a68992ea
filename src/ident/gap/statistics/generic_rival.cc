// Features of the flight as profiles of acceleration from outside, and their gain on blocks left out.
#include "ident/gap/statistics/generic_rival.h"

#include <algorithm>
#include <cmath>

#include "ident/core/parallel.h"
#include "ident/core/stage_times.h"
#include "ident/flight/conditioning/estimator_drift.h"
#include "ident/flight/record/motor_start.h"
#include "ident/gap/statistics/held_out_gain.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kChunk = 0.2;   // s: features are slow
constexpr double kPiece = 0.04;  // s: motors are fast
constexpr double kPart = 4.0;    // s
constexpr int kRounds = 30;  // until states are at their best: many where no rates or attitude were logged
constexpr Index kMotorFeatures = 5;
constexpr int kLeastSamples = 1000;  // samples of a sensor that can be judged
constexpr double kGross = 6.0;       // residuals of a sensor count up to this

double at(const std::vector<double>& column, std::size_t i) { return column.empty() ? 1.0 : column[i]; }

// One row for each chunk: what the flight shows there, and two velocities and rates before.
MatrixXd features(const FlightRecord& record, const FlightSmoother& smoother, double hover) {
  const auto& places = smoother.chunks();
  const auto& states = smoother.states();
  const auto N = static_cast<std::size_t>(record.layout.rotors);
  std::vector<VectorXd> rows;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(places[k].arc)];
    const FlightState<double>& x = states[k];
    const Mat3<double> R = rotation(x.body.q_WB);
    const Eigen::Vector3d v = R.transpose() * x.body.v_W, w = x.body.w_B;
    std::vector<double> f;
    for (int c = 0; c < 3; ++c)
      f.insert(f.end(), {v[c], v[c] * v.norm(), w[c], R(2, c), w[c] * w[(c + 1) % 3]});
    f.insert(f.end(), {v.head<2>().squaredNorm(), R(0, 0), R(1, 0)});
    double thrust = 0;
    for (std::size_t n = 0; n < N; ++n) {
      const double ratio = x.motors[n].Omega / hover;
      thrust += ratio * ratio / static_cast<double>(N);
      f.insert(f.end(), {ratio * ratio, x.motors[n].Omega_dot / hover});
    }
    const double z = std::max(record.vehicle->ground_z - x.body.x_W[2], 0.0);
    f.insert(f.end(), {thrust * thrust, thrust / (0.05 + z * z),
                       at(arc.inputs->voltage_ratio, places[k].begin) * thrust,
                       (arc.t[places[k].begin] - arc.inputs->t0) * thrust});
    // Memory: a swinging load, air that has to be set in motion.
    for (const std::size_t back : {1UL, 3UL}) {
      const bool there = k >= back && places[k - back].arc == places[k].arc;
      const FlightState<double>& y = there ? states[k - back] : x;
      for (int c = 0; c < 3; ++c) f.insert(f.end(), {y.body.v_W[c] - x.body.v_W[c], y.body.w_B[c] - w[c]});
    }
    rows.push_back(Eigen::Map<VectorXd>(f.data(), static_cast<Index>(f.size())));
  }
  MatrixXd X(static_cast<Index>(rows.size()), rows.empty() ? 0 : rows[0].size());
  for (std::size_t k = 0; k < rows.size(); ++k) X.row(static_cast<Index>(k)) = rows[k];
  standardise(X);
  return X;
}

// [arc][row]: the motors by their commands alone. What was measured of them would bring its noise into both
// sides of the regression.
using Motors = std::vector<std::vector<std::array<MotorState<double>, kMaxRotors>>>;
Motors commanded_motors(const FlightRecord& record, const std::vector<double>& p) {
  Motors out;
  const EffectSet<double> effects(p, active_effects(p));
  for (const FlightArc& arc : record.arcs) {
    Flight<double, EffectSet<double>> flight(*record.vehicle, p, effects, *arc.inputs);
    std::array<MotorState<double>, kMaxRotors> motors{};
    if (arc.inputs->commanded()) motors = motors_at_start(flight, arc.t[0], record.vehicle->rotors.size());
    out.emplace_back();
    for (std::size_t i = 0; i < arc.rows(); ++i) {
      out.back().push_back(motors);
      if (i + 1 < arc.rows()) flight.advance(motors, arc.t[i], arc.t[i + 1] - arc.t[i]);
    }
  }
  return out;
}

int part_of(const FlightArc& arc, int number, std::size_t row) {
  return static_cast<int>(std::abs(arc.t[row]) / kPart) + 1000 * number;
}

// X and the mean size of each rotor's acceleration over the chunk: what differs between speeding up and
// slowing down shows in nothing else.
MatrixXd with_effort(const MatrixXd& X, int rotors, const FlightSmoother& smoother, const Motors& motors) {
  MatrixXd effort = MatrixXd::Zero(X.rows(), rotors);
  for (Index k = 0; k < X.rows(); ++k) {
    const ChunkPlace& place = smoother.chunks()[static_cast<std::size_t>(k)];
    const auto& arc = motors[static_cast<std::size_t>(place.arc)];
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(place.end - place.begin, 1));
    for (std::size_t i = place.begin; i < place.end; ++i)
      for (Index n = 0; n < effort.cols(); ++n)
        effort(k, n) += share * std::abs(arc[i][static_cast<std::size_t>(n)].Omega_dot);
  }
  standardise(effort);
  MatrixXd all(X.rows(), X.cols() + effort.cols());
  all << X, effort;
  return all;
}

// Weighted residuals of a channel in rows [begin, end) of a chunk, and how many.
struct Sum {
  double sum = 0, count = 0;
};
Sum sum_of(const std::vector<double>& residuals, std::size_t channel, std::size_t begin, std::size_t end) {
  Sum out;
  for (std::size_t i = begin; i < end && (i + 1) * kChannels <= residuals.size(); ++i)
    if (const double r = residuals[i * kChannels + channel]; std::isfinite(r))
      out.sum += std::clamp(r, -kGross, kGross), out.count += 1;
  return out;
}

// What the sensors show beyond the model, channel by channel; a constant is one of the features.
void add_sensors(Rival& rival, const FlightRecord& record, const FlightSmoother& smoother,
                 const std::vector<std::vector<double>>& residuals, const MatrixXd& X) {
  MatrixXd with_constant(X.rows(), X.cols() + 1);
  with_constant << X, VectorXd::Ones(X.rows());
  std::vector<int> parts;
  for (const ChunkPlace& place : smoother.chunks())
    parts.push_back(part_of(record.arcs[static_cast<std::size_t>(place.arc)], place.arc, place.begin));
  std::vector<double> gains(static_cast<std::size_t>(kRotorChannel + record.layout.rotors), kNaN);
  in_parallel(gains.size(), [&](std::size_t channel) {
    if (is_slowly_off(record, static_cast<int>(channel))) return;
    SensorResiduals of{VectorXd::Zero(X.rows()), VectorXd::Zero(X.rows())};
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      const Sum whole = sum_of(residuals[k], channel, 0, residuals[k].size());
      of.sum[static_cast<Index>(k)] = whole.sum, of.count[static_cast<Index>(k)] = whole.count;
    }
    if (of.count.sum() >= kLeastSamples) gains[channel] = held_out_gain(of, with_constant, parts);
  });
  for (std::size_t channel = 0; channel < gains.size(); ++channel)
    if (std::isfinite(gains[channel]))
      rival.sensors.emplace_back(channel_name(static_cast<int>(channel)), gains[channel]);
}

// The rotors' speeds once more, in pieces as short as motors are fast, by what each does itself: one
// regression for all of them.
void add_motors(Rival& rival, const FlightRecord& record, const FlightSmoother& smoother,
                const std::vector<std::vector<double>>& residuals, const Motors& motors, double hover) {
  if (!record.signals.commands || !record.signals.rotor_speeds) return;
  std::vector<double> features, sum, count;
  std::vector<int> parts;
  const auto rotors = static_cast<std::size_t>(record.layout.rotors);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    for (std::size_t begin = place.begin, end = begin; begin < place.end; begin = end) {
      while (end < place.end && arc.t[end] - arc.t[begin] < kPiece) ++end;
      const double share = 1.0 / (hover * static_cast<double>(end - begin));
      for (std::size_t n = 0; n < rotors; ++n) {
        double speed = 0, change = 0, effort = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const MotorState<double>& motor = motors[static_cast<std::size_t>(place.arc)][i][n];
          speed += share * motor.Omega, change += share * motor.Omega_dot;
          effort += share * std::abs(motor.Omega_dot);
        }
        const Sum here = sum_of(residuals[k], kRotorChannel + n, begin - place.begin, end - place.begin);
        features.insert(features.end(), {speed, speed * speed, change, effort, change * effort});
        sum.push_back(here.sum), count.push_back(here.count);
        parts.push_back(part_of(arc, place.arc, begin));
      }
    }
  }
  const auto pieces = static_cast<Index>(parts.size());
  const SensorResiduals of{Eigen::Map<VectorXd>(sum.data(), pieces),
                           Eigen::Map<VectorXd>(count.data(), pieces)};
  if (of.count.sum() < kLeastSamples) return;
  MatrixXd X = Eigen::Map<MatrixXd>(features.data(), kMotorFeatures, pieces).transpose();
  standardise(X);
  X.conservativeResize(Eigen::NoChange, kMotorFeatures + 1);
  X.rightCols<1>().setOnes();
  rival.sensors.emplace_back("motors", held_out_gain(of, X, parts));
}

}  // namespace

double Rival::total() const {
  double sum = 0;
  for (const double x : gain) sum += std::max(x, 0.0);
  for (const auto& [channel, x] : sensors) sum += std::max(x, 0.0);
  return sum;
}

std::string Rival::strongest() const {
  static constexpr std::array wrench = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  const auto most = std::ranges::max_element(gain);
  std::string name = wrench[static_cast<std::size_t>(most - gain.begin())];
  double best = *most;
  for (const auto& [channel, x] : sensors)
    if (x > best) best = x, name = channel;
  return name;
}

Rival generic_rival(const FlightRecord& record, const Theta& theta, const FlightFit& fit,
                    const NoiseModel& floor) {
  const Stage stage("regression on what is left");
  Rival rival;
  FlightSmoother smoother(record, theta, floor, std::max(fit.chunk_seconds, kChunk));
  if (smoother.chunks().size() < 60) return rival;
  rival.judged = true;
  smoother.set_steps(fit.smoother->steps());
  smoother.start_from(*fit.smoother);
  smoother.settle(fit.u, kRounds);
  const std::vector<double> p = theta.p(fit.u);
  const double hover =
      std::sqrt(p[param::m] * record.vehicle->g / (static_cast<double>(record.layout.rotors) * p[param::kT]));
  const MatrixXd X = features(record, smoother, hover);
  const auto residuals = smoother.residuals();
  add_sensors(rival, record, smoother, residuals, X);
  const Motors motors = commanded_motors(record, p);
  add_motors(rival, record, smoother, residuals, motors, hover);
  const PriorTerms prior = theta.prior(fit.u);
  double push = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (const AirNoise& air : floor.air)
    for (std::size_t k = 0; k < 3; ++k) {
      push += air.v_dot[k].sigma / (3 * static_cast<double>(floor.air.size()));
      turn[static_cast<Index>(k)] += air.w_dot[k].sigma / static_cast<double>(floor.air.size());
    }
  const MatrixXd all = with_effort(X, record.layout.rotors, smoother, motors);
  for (int channel = 0; channel < 6; ++channel) {
    const bool force = channel < 3;
    if (force ? record.layout.v_dot < 0 : record.layout.w_dot < 0) continue;
    std::vector<MatrixXd> profiles;
    for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
      Eigen::Matrix<double, 6, 1> direction = Eigen::Matrix<double, 6, 1>::Zero();
      if (force)
        direction.tail<3>() = push * rotation(smoother.states()[k].body.q_WB).col(channel);
      else
        direction[channel - 3] = turn[channel - 3];
      profiles.emplace_back(direction * all.row(static_cast<Index>(k)));
    }
    smoother.set_profiles(std::move(profiles));
    smoother.relinearize();
    smoother.accept();
    const std::vector<ScoreBlock> blocks = smoother.score_blocks(2.0);
    double& gain = rival.gain[static_cast<std::size_t>(channel)];
    gain = -1e300;
    for (const double size : kRegressionSizes) gain = std::max(gain, held_out_gain(blocks, prior, size));
    if (gain == -1e300) gain = 0;  // nothing that can be judged
  }
  return rival;
}

}  // namespace ident
