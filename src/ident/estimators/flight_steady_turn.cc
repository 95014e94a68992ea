// Time means over the states of a fit, as moments.
#include "ident/estimators/flight_steady_turn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"

namespace ident {
namespace {

using Eigen::Vector3d;

// Of the arm, by which the centre of gravity is off; of the torque of all rotors.
constexpr double kOfArm = 0.01, kOfTorque = 0.1;
constexpr double kBeyondChance = 5.0;
// Means over so many seconds are gusts that have nothing to do with each other; of so many or more of them
// the scatter tells how far chance takes their mean.
constexpr double kBlock = 3.0;
constexpr std::size_t kFewBlocks = 6;

// Means of accelerations over blocks of time.
struct Blocks {
  std::vector<Vector3d> means;
  Vector3d sum = Vector3d::Zero();
  double seconds = 0;

  void add(double h, const Vector3d& w_dot) {
    sum += h * w_dot, seconds += h;
    if (seconds < kBlock) return;
    means.push_back(sum / seconds);
    sum.setZero(), seconds = 0;
  }

  SteadyTurn moment(const Eigen::Matrix3d& J) const {
    if (means.size() < kFewBlocks) return {};
    const double n = static_cast<double>(means.size());
    Vector3d mean = Vector3d::Zero(), square = Vector3d::Zero();
    for (const Vector3d& one : means) mean += J * one / n;
    for (const Vector3d& one : means) square += (J * one - mean).cwiseAbs2();
    return {mean, (square / (n * (n - 1))).cwiseSqrt(), Vector3d::Zero(), {}};
  }
};

double arm_of(const Vehicle& vehicle) {
  double arm = 0;
  for (const Rotor& r : vehicle.rotors) arm = std::max(arm, r.r_B.head<2>().norm());
  return arm;
}

// The torques of all rotors that carry the weight, summed without sign, N m.
double torque_of(const Vehicle& vehicle, std::span<const double> p) {
  return p[param::kQ] / p[param::kT] * p[param::m] * vehicle.g;
}

}  // namespace

double SteadyTurn::times() const {
  double most = 0;
  for (int i = 0; i < 3; ++i)
    if (matters[i] > 0)
      most = std::max(most, std::abs(mean[i]) / std::max(matters[i], kBeyondChance * std[i]));
  return most;
}

SteadyTurn steady_turn(const FlightRecord& record, const Theta& theta, const FlightFit& fit) {
  if (record.layout.w_dot < 0) return {};
  const FlightSmoother& smoother = *fit.smoother;
  std::vector<Blocks> of_log(static_cast<std::size_t>(record.logs));
  for (std::size_t k = 0; k < smoother.chunks().size(); ++k) {
    const ChunkPlace& place = smoother.chunks()[k];
    const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
    of_log[static_cast<std::size_t>(arc.log)].add(arc.t[place.end] - arc.t[place.begin],
                                                  smoother.states()[k].outside.w_dot_B);
  }
  Blocks all;
  for (const Blocks& one : of_log) all.means.insert(all.means.end(), one.means.begin(), one.means.end());
  const Eigen::Matrix3d J = theta.inertia(fit.u);
  const std::vector<double> p = theta.p(fit.u);
  const double level = kOfArm * arm_of(*record.vehicle) * p[param::m] * record.vehicle->g;
  const Vector3d matters(level, level, kOfTorque * torque_of(*record.vehicle, p));
  SteadyTurn most = all.moment(J);
  most.matters = matters;
  for (int log = 0; log < record.logs && record.logs > 1; ++log) {
    SteadyTurn one = of_log[static_cast<std::size_t>(log)].moment(J);
    one.matters = matters, one.log = log;
    if (one.times() > most.times()) most = one;
  }
  return most;
}

void warn_of_steady_turn(Result& result, const SteadyTurn& turn, const Vehicle& vehicle,
                         std::span<const double> p, std::span<const FlightLog> logs) {
  if (!(turn.times() > 1)) return;
  const double weight = p[param::m] * vehicle.g;
  const double ahead = -turn.mean[1] / weight,
               right = turn.mean[0] / weight;  // weight's lever about the thrust
  const double torque = std::abs(turn.mean[2]) / torque_of(vehicle, p);
  const std::string where =
      turn.log ? "of " + logs[static_cast<std::size_t>(*turn.log)].file : std::string("of these logs");
  const std::string yaw = std::abs(turn.mean[2]) > turn.matters[2] && turn.matters[2] > 0
                              ? fmt::format(", or {:.0f} % more torque one way than the other", 100 * torque)
                              : "";
  result.warn(
      "steady_moment",
      fmt::format(
          "in the mean {} moments of {}, {} and {} N m about x, y and z turn the vehicle that the model does "
          "not have, and no gust lasts as long: as with its centre of gravity {} mm {} and {} mm {} of where "
          "it is stated ({:.1f} % of the arm), or rotors unlike each other{}. They count as gusts here, and "
          "constants may be bent for their cause (try ident gap)",
          where, format_number(turn.mean[0], 2), format_number(turn.mean[1], 2),
          format_number(turn.mean[2], 2), format_number(1e3 * std::abs(ahead), 2),
          ahead > 0 ? "ahead" : "behind", format_number(1e3 * std::abs(right), 2),
          right > 0 ? "right" : "left", 100 * std::hypot(ahead, right) / arm_of(vehicle), yaw));
}

}  // namespace ident
