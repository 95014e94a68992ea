// Time means over the states of a fit, as moments.
#include "ident/flight/checks/mean_moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

using Eigen::Vector3d;

// Of the arm, by which the centre of gravity is off; of the torque of all rotors.
constexpr double kOfArm = 0.01, kOfTorque = 0.1;
// Of a log, that chance alone makes of three axes what stands out of them.
constexpr double kChance = 1e-3;
// Seconds of a block, whose means tell by their scatter how far chance takes the mean of so many or more.
constexpr double kBlock = 3.0;
constexpr std::size_t kFewBlocks = 6;
constexpr double kMostAlike = 0.8;

double arm_of(const Vehicle& vehicle) {
  double arm = 0;
  for (const Rotor& r : vehicle.rotors) arm = std::max(arm, r.r_B.head<2>().norm());
  return arm;
}

// Means of moments over blocks of time.
struct Blocks {
  std::vector<Vector3d> means;
  Vector3d sum = Vector3d::Zero();
  double seconds = 0;

  void add(double h, const Vector3d& moment) {
    sum += h * moment, seconds += h;
    if (seconds < kBlock) return;
    means.push_back(sum / seconds);
    sum.setZero(), seconds = 0;
  }
};

SteadyTurn mean_of(const Blocks& blocks, int tested) {
  SteadyTurn out;
  if (blocks.means.size() < kFewBlocks) return out;
  const double n = static_cast<double>(blocks.means.size());
  const double far = t_quantile(1 - kChance / (6.0 * tested), n - 1);
  Vector3d square = Vector3d::Zero(), next = Vector3d::Zero();
  for (const Vector3d& one : blocks.means) out.mean += one / n;
  for (std::size_t k = 0; k < blocks.means.size(); ++k) {
    const Vector3d off = blocks.means[k] - out.mean;
    square += off.cwiseAbs2();
    if (k > 0) next += off.cwiseProduct(blocks.means[k - 1] - out.mean);
  }
  for (int i = 0; i < 3; ++i) {
    // Slow gusts are alike in blocks that follow each other; of few of these that shows too little by 1/n.
    const double alike = std::clamp(next[i] / square[i] + 1 / n, 0.0, kMostAlike);
    out.chance[i] = far * std::sqrt((1 + alike) / (1 - alike) * square[i] / (n * (n - 1)));
  }
  return out;
}

}  // namespace

double SteadyTurn::times(int axis) const {
  const double least = std::max(matters[axis], chance[axis]);
  return matters[axis] > 0 ? std::abs(mean[axis]) / least : 0.0;
}

double SteadyTurn::times() const { return std::max({times(0), times(1), times(2)}); }

SteadyTurn steady_turn(const FlightRecord& record, const Theta& theta, const FlightFit& fit) {
  const FlightSmoother& smoother = *fit.smoother;
  const std::vector<double> p = theta.p(fit.u);
  MassSeam<double> mass{p[param::m], Mat3<double>::Zero(), Vec3<double>::Zero(), p[param::Jp]};
  EffectSet<double>(p, active_effects(p)).apply(mass);
  const double weight = mass.m * record.vehicle->g;
  const Vector3d J = theta.inertia(fit.u).diagonal();  // see Disturbance
  std::vector<Blocks> of_log(static_cast<std::size_t>(record.logs));
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    of_log[static_cast<std::size_t>(arc.log)].add(arc.t[place.end] - arc.t[place.begin],
                                                  J.cwiseProduct(smoother.states()[k].outside.w_dot_B));
  }
  Blocks all;
  const int tested = record.logs > 1 ? record.logs + 1 : 1;
  SteadyTurn most;
  const auto look = [&](const Blocks& blocks, std::optional<int> log) {
    SteadyTurn one = mean_of(blocks, tested);
    const double torque = p[param::kQ] / p[param::kT] * weight;  // of all rotors, without sign
    one.matters.head<2>().setConstant(kOfArm * arm_of(*record.vehicle) * weight);
    one.matters[2] = kOfTorque * torque;
    one.weight = weight, one.log = log;
    if (one.times() > most.times()) most = one;
  };
  for (int log = 0; log < record.logs; ++log) {
    const Blocks& blocks = of_log[static_cast<std::size_t>(log)];
    all.means.insert(all.means.end(), blocks.means.begin(), blocks.means.end());
    if (record.logs > 1) look(blocks, log);
  }
  look(all, {});
  return most;
}

void warn_of_steady_turn(Result& result, const SteadyTurn& turn, const FlightRecord& record,
                         std::span<const FlightLog> logs) {
  if (!(turn.times() > 1)) return;
  std::string moments, cause;
  const auto append = [](std::string& to, const std::string& what, const char* between) {
    to += (to.empty() ? "" : between) + what;
  };
  for (int i = 0; i < 3; ++i)
    if (turn.times(i) > 1)
      append(moments, fmt::format("{} N m about {}", format_number(turn.mean[i], 2), "xyz"[i]), ", ");
  // The weight's lever about the thrust.
  const double ahead = -turn.mean[1] / turn.weight, right = turn.mean[0] / turn.weight;
  std::string place;
  if (turn.times(1) > 1)
    append(place,
           format_number(1e3 * std::abs(ahead), 2) + (ahead > 0 ? " mm further ahead" : " mm further back"),
           " and ");
  if (turn.times(0) > 1)
    append(place,
           format_number(1e3 * std::abs(right), 2) + (right > 0 ? " mm further right" : " mm further left"),
           " and ");
  const double lever = std::hypot(turn.times(1) > 1 ? ahead : 0, turn.times(0) > 1 ? right : 0);
  if (!place.empty())
    append(cause,
           fmt::format("as with its centre of gravity {} than it is stated ({:.1f} % of the arm)", place,
                       100 * lever / arm_of(*record.vehicle)),
           "");
  if (turn.times(2) > 1)
    append(cause,
           fmt::format("as with {:.0f} % more torque of its rotors one way than the other",
                       100 * kOfTorque * std::abs(turn.mean[2]) / turn.matters[2]),
           ", ");
  const std::string where =
      turn.log ? logs[static_cast<std::size_t>(*turn.log)].file : std::string("these logs");
  result.warn("steady_moment",
              fmt::format("In the mean of {} a moment acts that the model lacks: {}; no gust lasts that "
                          "long. It is {}, or with rotors that differ. It counts as gusts, and its cause may "
                          "bias constants. Balance the vehicle, compare its rotors, and run `ident gap`.",
                          where, moments, cause));
}

}  // namespace ident
