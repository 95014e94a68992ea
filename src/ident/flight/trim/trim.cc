// Balance of stretches of flight, its scatter, and its fit.
#include "ident/flight/trim/trim.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/error.h"
#include "ident/flight/record/channel_units.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMost = 40.0;       // stretches of a log: longer ones in longer logs
constexpr double kEnds = 1.0;        // s after take-off and before landing that are left out
constexpr double kDifference = 0.1;  // s to either side, for accelerations from a path
constexpr double kSample = 0.02;     // s between the moments of a stretch that are looked at
constexpr double kAloft = 0.3;       // share of the weight below which something else carries the vehicle
constexpr double kEqual = 0.1;       // rotors of one make, and where the battery sits

// The channels of a path, and how often it is differenced for accelerations.
struct Path {
  int channel, order;
};

double interpolated(const FlightArc& arc, int channel, double t) {
  const auto at = [&](std::size_t i) { return arc.y[i * kChannels + static_cast<std::size_t>(channel)]; };
  auto hi = static_cast<std::size_t>(std::ranges::lower_bound(arc.t, t) - arc.t.begin());
  std::size_t lo = hi == 0 ? 0 : hi - 1;
  while (hi < arc.rows() && !std::isfinite(at(hi))) ++hi;
  while (lo > 0 && !std::isfinite(at(lo))) --lo;
  if (hi >= arc.rows() || !std::isfinite(at(lo))) return kNaN;
  return hi == lo ? at(hi) : at(lo) + (t - arc.t[lo]) / (arc.t[hi] - arc.t[lo]) * (at(hi) - at(lo));
}

// Specific force that the path asks for at t, m/s^2.
double needed_at(const FlightArc& arc, const Path& path, double g, double t) {
  Eigen::Vector3d a;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](double s) { return interpolated(arc, path.channel + k, s); };
    const double h = path.order * kDifference;
    a[k] =
        path.order == 1 ? (at(t + h) - at(t - h)) / (2 * h) : (at(t + h) - 2 * at(t) + at(t - h)) / (h * h);
  }
  return (a - Eigen::Vector3d(0, 0, g)).norm();
}

// What noise of the path across the thrust adds to the mean size of what it asks for, m/s^2.
double rectified_noise(const FlightRecord& record, const Path& path) {
  double variance = 0;
  for (const std::size_t axis : {0U, 1U}) {
    const double white = record.sigma[static_cast<std::size_t>(path.channel) + axis];
    const double h = path.order * kDifference;
    variance += path.order == 1 ? white * white / (2 * h * h) : 6 * white * white / std::pow(h, 4);
  }
  return variance / (2 * record.vehicle->g);
}

// What the model's rotors do on the average of a stretch, with the vehicle level: thrust over mass, m/s^2,
// and moments about the centre of gravity over thrust, m.
Eigen::Vector4d mean_wrench(const FlightRecord& record, const std::vector<double>& p, const TrimStretch& s) {
  const FlightArc& arc = record.arcs[static_cast<std::size_t>(s.arc)];
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(*record.vehicle, p, effects, *arc.inputs);
  const double high = record.vehicle->ground_z - 1e3;  // no ground effect
  FlightState<double> level{
      {Vec4<double>(1, 0, 0, 0), Vec3<double>::Zero(), Vec3<double>::Zero(), Vec3<double>(0, 0, high)},
      {},
      {}};
  const std::size_t rotors = record.vehicle->rotors.size();
  const double from = arc.t[s.begin], to = arc.t[s.end - 1];
  double t = std::max(from - kEnds, arc.t.front());
  if (arc.inputs->commanded())
    for (std::size_t n = 0; n < rotors; ++n) level.motors[n] = {flight.steady_speed(n, t), 0.0};
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();  // N, N m
  double count = 0;
  for (; t < to; t += kSample) {
    if (arc.inputs->commanded())
      flight.advance(level.motors, t, kSample);
    else
      flight.rate(level, t);  // sets the motors from what was measured
    if (t < from) continue;
    auto steady = level.motors;  // what it takes to spin them up turns the vehicle to and fro
    for (MotorState<double>& motor : steady) motor.Omega_dot = 0.0;
    const Wrench<double> total =
        flight.body().wrench(level.body, Mat3<double>::Identity(), std::span(steady).first(rotors));
    const Vec3<double> M = total.M_B - cross(flight.body().centre_of_gravity(), total.F_B);
    sum += Eigen::Vector4d(-total.F_B[2], M[0], M[1], M[2]);
    count += 1;
  }
  sum.tail<3>() /= sum[0];
  sum[0] /= std::max(count, 1.0) * flight.body().mass();
  return sum;
}

}  // namespace

bool only_trim(const Signals& logged) {
  return !logged.rates && !logged.attitude && (logged.velocity || logged.position) &&
         (logged.commands || logged.rotor_speeds);
}

bool states_rotor_ratios(const Vehicle& vehicle) {
  return std::ranges::any_of(vehicle.parameters, [](const auto& entry) {
    return is_rotor_ratio(entry.first) && entry.second.std.value_or(0.0) > 0;
  });
}

Trim make_trim(const FlightRecord& record, const std::vector<double>& p) {
  Trim trim;
  const double g = record.vehicle->g;
  trim.weight = p[param::m] * g, trim.drag = p[param::kQ] / p[param::kT];
  for (const Rotor& rotor : record.vehicle->rotors) trim.reach = std::max(trim.reach, rotor.r_B.norm());
  const Path path = record.signals.velocity ? Path{kVelocity, 1} : Path{kPosition, 2};
  const double rectified = rectified_noise(record, path);
  std::set<int> logs;
  for (std::size_t k = 0; k < record.arcs.size(); ++k) {
    const FlightArc& arc = record.arcs[k];
    const double from = arc.t.front() + kEnds, to = arc.t.back() - kEnds;
    const double length = std::max(kShortestStretch, (to - from) / kMost);
    const auto row = [&](double t) {
      return static_cast<std::size_t>(std::ranges::lower_bound(arc.t, t) - arc.t.begin());
    };
    for (double begin = from; begin + length <= to; begin += length) {
      TrimStretch s{arc.log, static_cast<int>(k), row(begin), row(begin + length), begin + length / 2, 0.0};
      double sum = 0, count = 0;
      for (double t = begin; t < begin + length; t += kDifference)
        if (const double f = needed_at(arc, path, g, t); std::isfinite(f)) sum += f, count += 1;
      s.needed = sum / std::max(count, 1.0) - rectified;
      if (s.end <= s.begin + 1 || !(s.needed > kAloft * g)) continue;
      if (mean_wrench(record, p, s)[0] < kAloft * g) continue;
      trim.stretches.push_back(s);
      logs.insert(arc.log);
    }
  }
  trim.logs = static_cast<int>(logs.size());
  if (!(trim.reach > 0))
    throw DataError(
        "neither rates nor attitude were logged (or they never change), and a rotor at the origin "
        "balances whatever it does; log rates or attitude");
  if (trim.stretches.size() < 2)
    throw DataError(
        "neither rates nor attitude were logged (or they never change), and the flight is too short for the "
        "balance of its rotors: some 7 s aloft without a gap are needed; log rates or attitude");
  return trim;
}

VectorXd unbalance(const FlightRecord& record, const Trim& trim, const std::vector<double>& p) {
  VectorXd y(trim.rows());
  for (std::size_t k = 0; k < trim.stretches.size(); ++k) {
    Eigen::Vector4d w = mean_wrench(record, p, trim.stretches[k]);
    w[0] = w[0] / trim.stretches[k].needed - 1;
    w.tail<3>() /= trim.reach;
    // Balanced is balanced whatever the drag on the whole: less of it would only make an unbalance look
    // small.
    w[3] *= trim.drag * p[param::kT] / p[param::kQ];
    y.segment<kTrimChannels>(kTrimChannels * static_cast<Index>(k)) = w;
  }
  return y;
}

MatrixXd trim_slopes(const FlightRecord& record, const Trim& trim, const Theta& theta, const VectorXd& u) {
  constexpr double h = 1e-4;
  MatrixXd Y = MatrixXd::Zero(trim.rows(), theta.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    // How fast rotors follow changes their mean thrust a little: too little to learn it from that.
    const int index = theta.constants()[static_cast<std::size_t>(i)].index;
    if (index == param::omega_m || index == param::zeta_m || index == param::dead_time) continue;
    VectorXd more = u, less = u;
    more[i] += h, less[i] -= h;
    Y.col(i) = (unbalance(record, trim, theta.p(more)) - unbalance(record, trim, theta.p(less))) / (2 * h);
  }
  return Y;
}

std::vector<FreeConstant> trim_constants(const FlightRecord& record, const std::vector<double>& p,
                                         std::vector<std::string> also) {
  for (std::size_t k = 1; k <= record.vehicle->rotors.size(); ++k) also.push_back(rotor_ratio(k));
  std::vector<FreeConstant> constants = free_constants(*record.vehicle, p, also);
  if (!record.signals.commands) leave_out_motors(constants);
  for (FreeConstant& c : constants)
    if (is_rotor_ratio(c.name) && !c.prior_std) c.prior_value = c.start, c.prior_std = kEqual;
  return constants;
}

}  // namespace ident
