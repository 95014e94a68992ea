// Streams of a log against each other, and what is moved.
#include "ident/flight/conditioning/align_streams.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/parallel.h"
#include "ident/flight/conditioning/motion_tracks.h"
#include "ident/flight/conditioning/shift_log.h"
#include "ident/flight/record/initial_states.h"

namespace ident {
namespace {

constexpr double kLag = 0.12;  ///< s of a window: short, for time to show
/// Shorter yet for rotor speeds: a vehicle that climbs takes thrust back after a while, which looks late.
constexpr double kLagOfSpeeds = 0.04;
constexpr double kLatestPath = 0.3, kEarliestForce = 0.06;  ///< s: a GPS receiver is late
constexpr double kShortTime = 0.03;  ///< s before and after over which an acceleration is taken
/// s of rates and of specific force that matter: turns about a lever arm look like some ms of the force.
constexpr double kShortestOfRates = 1e-3, kShortestOfForce = 8e-3;
/// s by which rotor speeds are later than the force that they make; earlier they are by any filter of that.
constexpr double kShortestOfSpeeds = 4e-3;
constexpr double kHalfSure = 2.0;      ///< standard deviations of what another sensor tells more sharply
constexpr double kSureOfSpeeds = 3.0;  ///< standard deviations
constexpr double kSureOfTurns = 3.5;   ///< standard deviations
/// s by which an autopilot's filters make the sensors of its IMU late
constexpr double kLongestFilter = 8e-3;

std::size_t half_width(const FlightArc& arc) {
  const double interval = (arc.t.back() - arc.t.front()) / static_cast<double>(arc.rows() - 1);
  return static_cast<std::size_t>(std::max(1.0, std::round(kShortTime / std::max(interval, 1e-6))));
}

/// The running integral of the size of the acceleration less gravity, as the velocity shows it, m/s. Sizes do
/// not ask for the attitude, which may be late itself.
Track sum_of_acceleration(const FlightArc& arc, double gravity) {
  const Track3 v = velocity_W(arc);
  const std::size_t rows = arc.rows(), half = half_width(arc);
  Track size(rows, gravity);
  for (std::size_t i = half; i + half < rows; ++i) {
    Eigen::Vector3d a(0, 0, -gravity);
    for (std::size_t k = 0; k < 3; ++k)
      a[static_cast<Eigen::Index>(k)] +=
          (v[k][i + half] - v[k][i - half]) / (arc.t[i + half] - arc.t[i - half]);
    size[i] = a.norm();
  }
  return integral(arc.t, size);
}

/// The same of the specific force, over the same short times.
Track sum_of_force(const FlightArc& arc) {
  const Track3 f = specific_force(arc);
  const Track3 sums = integrals(arc, f);
  const std::size_t rows = arc.rows(), half = half_width(arc);
  Track size(rows, 0.0);
  for (std::size_t i = half; i + half < rows; ++i) {
    Eigen::Vector3d mean;
    for (std::size_t k = 0; k < 3; ++k)
      mean[static_cast<Eigen::Index>(k)] =
          (sums[k][i + half] - sums[k][i - half]) / (arc.t[i + half] - arc.t[i - half]);
    size[i] = mean.norm();
  }
  return integral(arc.t, size);
}

/// Whether a channel has samples enough for lines between them to stand for what lies there.
bool sampled_often(const FlightArc& arc, int channel) {
  constexpr double kLeastStreams = 0.1;
  double sampled = 0;
  for (std::size_t i = 0; i < arc.rows(); ++i)
    sampled += std::isfinite(arc.y[i * kChannels + static_cast<std::size_t>(channel)]);
  return sampled > kLeastStreams * static_cast<double>(arc.rows());
}

/// Where speeds are the input they are none of the channels.
bool has_speed(const FlightArc& arc, int rotor) {
  const auto& input = arc.inputs->Omega;
  if (arc.inputs->commanded()) return sampled_often(arc, kRotorChannel + rotor);
  return rotor < std::ssize(input) && input[static_cast<std::size_t>(rotor)].size() == arc.rows();
}
Track speed_of(const FlightArc& arc, int rotor) {
  return arc.inputs->commanded() ? filled_column(arc, kRotorChannel + rotor)
                                 : arc.inputs->Omega[static_cast<std::size_t>(rotor)];
}

/// The running integral of the squares of speeds as measured, each times what `of` gives for its rotor.
template <class Of>
Track sum_over_rotors(const FlightArc& arc, const FlightRecord& record, const Of& of) {
  Track sum(arc.rows(), 0.0);
  for (int n = 0; n < record.layout.rotors; ++n) {
    const double times = of(record.vehicle->rotors[static_cast<std::size_t>(n)]);
    const Track speed = speed_of(arc, n);
    for (std::size_t i = 0; i < speed.size(); ++i) sum[i] += times * speed[i] * speed[i];
  }
  return integral(arc.t, sum);
}

/// Thrust along z, over kT.
Track sum_of_thrust(const FlightArc& arc, const FlightRecord& record) {
  return sum_over_rotors(arc, record,
                         [&](const Rotor& rotor) { return axis_at(rotor, record.p[param::alpha])[2]; });
}

/// Moment of thrust about an axis, over kT.
Track sum_of_moment(const FlightArc& arc, const FlightRecord& record, Eigen::Index axis) {
  return sum_over_rotors(arc, record, [&](const Rotor& rotor) {
    return rotor.r_B.cross(axis_at(rotor, record.p[param::alpha]))[axis];
  });
}

}  // namespace

StreamOffsets stream_offsets(const FlightRecord& record, double gravity) {
  const Signals& s = record.signals;
  const auto turns = [](const FlightArc& arc) {
    const auto all = [](const Track3& x) { return std::vector<Track>(x.begin(), x.end()); };
    return StreamSides{all(turn_of_attitude(arc)), all(turn_of_rates(arc))};
  };
  const auto forces = [&](const FlightArc& arc) {
    return StreamSides{{sum_of_acceleration(arc, gravity)}, {sum_of_force(arc)}};
  };
  const auto any = [](const FlightArc&) { return true; };
  const auto offset_by = [&](bool logged, double lag, const auto& sides_of, const auto& serves,
                             double farthest = 0.0) {
    std::vector<StreamSides> sides;
    for (const FlightArc& arc : record.arcs)
      if (logged && arc.rows() > 1 && serves(arc)) sides.push_back(sides_of(arc));
    return offset_of(sides, record.interval, lag, farthest);
  };
  const auto has_speeds = [&](const FlightArc& arc) {
    bool all = true;
    for (int n = 0; n < record.layout.rotors; ++n) all = all && has_speed(arc, n);
    return all;
  };
  const auto shows_thrust = [&](const FlightArc& arc) {
    return has_speeds(arc) && sampled_often(arc, kForce + 2);
  };
  const auto thrusts = [&](const FlightArc& arc) {
    return StreamSides{{integral(arc.t, filled_column(arc, kForce + 2))}, {sum_of_thrust(arc, record)}};
  };
  const auto shows_moments = [&](const FlightArc& arc) {
    return has_speeds(arc) && sampled_often(arc, kGyro) && sampled_often(arc, kGyro + 1);
  };
  const auto moments = [&](const FlightArc& arc) {
    return StreamSides{{filled_column(arc, kGyro), filled_column(arc, kGyro + 1)},
                       {sum_of_moment(arc, record, 0), sum_of_moment(arc, record, 1)}};
  };
  StreamOffsets found;
  in_parallel(4, [&](std::size_t which) {
    if (which == 0)
      found.rates = offset_by(s.rates && s.attitude, kLag, turns, any);
    else if (which == 1)
      found.force = offset_by(s.force && (s.velocity || s.position), kLag, forces, any, kLatestPath);
    else if (which == 2)
      found.speeds = offset_by(s.force && s.rotor_speeds, kLagOfSpeeds, thrusts, shows_thrust);
    else
      found.moments = offset_by(s.rates && s.rotor_speeds, kLagOfSpeeds, moments, shows_moments);
  });
  return found;
}

namespace {

/// By how much earlier the streams are read, s, and what is said of it.
struct Moves {
  double rates = 0, force = 0, attitude = 0, path = 0, speeds = 0;
  std::vector<Warning> said;

  bool any() const { return !said.empty(); }
  void say(const std::string& what, const std::string& against, double late, double std,
           const char* how = "") {
    said.push_back(
        {"stream_offset",
         fmt::format("{} the same motion {} ms (± {}) {} than {}: {}read that much {}", what,
                     format_number(1e3 * std::abs(late), 2), format_number(1e3 * std, 1),
                     late > 0 ? "later" : "earlier", against, how, late > 0 ? "earlier" : "later")});
  }
};

// Late rates were filtered, and so was the specific force; what is later than that came by another way, or
// rotor speeds show that it is the IMU that is late.
void move_turns(const StreamOffsets& found, double interval, Moves& moves) {
  const StreamOffset &rates = found.rates, &speeds = found.speeds;
  if (!rates.matters(interval, kShortestOfRates)) return;
  const bool filtered = rates.seconds > 0 && rates.seconds < kLongestFilter;
  const bool imu = rates.seconds > 0 && speeds.matters(interval, kShortestOfSpeeds) &&
                   speeds.seconds < -0.5 * rates.seconds;
  if (filtered || imu) {
    moves.rates = moves.force = rates.seconds;
    moves.say("the rates show", "the attitude", rates.seconds, rates.std,
              filtered ? "as filtered, with the specific force, "
                       : "as rotor speeds say, with the specific force, ");
  } else {
    moves.attitude = moves.path = -rates.seconds;
    moves.say("attitude, velocity and position show", "the rates", -rates.seconds, rates.std);
  }
}

// What is then left between force and velocity. Where the force is in time with the rotor speeds that make
// it, it is the motion that is late; with the attitude, unless that is in time with the rates. So it is where
// the motion is later than any sensor is early, as that of a GPS receiver.
void move_force(const StreamOffsets& found, const FlightRecord& record, Moves& moves) {
  StreamOffset force = found.force;
  force.seconds += moves.path - moves.force;
  if (!force.matters(record.interval, kShortestOfForce)) return;
  const double half = 0.5 * std::abs(force.seconds), speeds = found.speeds.seconds + moves.force;
  const bool both = record.signals.velocity && record.signals.position;
  const std::string path = both ? "velocity and position" : record.signals.velocity ? "velocity" : "position";
  const bool in_time = std::abs(speeds) < half && kSureOfSpeeds * found.speeds.std < half;
  if (in_time || force.seconds < -kEarliestForce) {
    const bool attitude = record.signals.attitude && !std::isfinite(found.rates.std);
    moves.path -= force.seconds;
    if (attitude) moves.attitude -= force.seconds;
    moves.say((attitude ? "attitude, " : "the ") + path + (both ? " show" : " shows"),
              in_time ? "the specific force and the rotor speeds" : "the specific force", -force.seconds,
              force.std);
  } else {
    moves.force += force.seconds;
    moves.say("the specific force shows", "the " + path, force.seconds, force.std);
  }
}

// Speeds that are late are as late to what turns the vehicle, which mostly tells more sharply by how much. A
// load that swings, or air that damps climbs and turns, sets them apart in time as well, but by another time
// each.
void move_speeds(const StreamOffsets& found, double interval, Moves& moves) {
  StreamOffset speeds = found.speeds, moments = found.moments;
  speeds.seconds += moves.force, moments.seconds += moves.rates;
  if (!(speeds.seconds > kHalfSure * speeds.std)) return;
  const bool by_moments = moments.std < speeds.std;
  const StreamOffset& late = by_moments ? moments : speeds;
  if (!(late.seconds > 0) || !late.matters(interval, kShortestOfSpeeds)) return;
  const double apart = std::abs(moments.seconds - speeds.seconds);
  if (apart > std::max(kSureOfSpeeds * std::hypot(moments.std, speeds.std), 0.5 * late.seconds)) return;
  moves.speeds = late.seconds;
  moves.say("rotor speeds show", by_moments ? "the rates" : "the specific force", late.seconds, late.std);
}

}  // namespace

AlignedStreams aligned_streams(const FlightRecord& record, std::span<const FlightLog> logs, double gravity,
                               std::vector<Warning>& warnings) {
  const StreamOffsets found = stream_offsets(record, gravity);
  Moves moves;
  move_turns(found, record.interval, moves);
  move_force(found, record, moves);
  move_speeds(found, record.interval, moves);
  const double apart = std::abs(found.rates.seconds);
  AlignedStreams aligned{{}, apart > kSureOfTurns * found.rates.std ? apart : 0.0};
  if (!moves.any()) return aligned;
  warnings.insert(warnings.end(), moves.said.begin(), moves.said.end());
  aligned.logs.assign(logs.begin(), logs.end());
  for (FlightLog& log : aligned.logs) {
    const auto earlier = [&](auto& columns, double seconds) {
      if (seconds == 0) return;
      for (auto& column : columns) read_later(log.t, column, seconds);
    };
    earlier(log.w_B, moves.rates), earlier(log.f_B, moves.force);
    if (moves.attitude != 0 && log.has_attitude()) read_attitude_later(log, moves.attitude);
    earlier(log.v_W, moves.path), earlier(log.x_W, moves.path);
    earlier(log.Omega, moves.speeds);
  }
  return aligned;
}

}  // namespace ident
