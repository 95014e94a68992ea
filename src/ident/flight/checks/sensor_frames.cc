// Do the sensors of a log agree with each other and with gravity? Each contradiction names its axis.
//
//   integral of w over a window    = turn of the attitude, body axes                                    (1)
//   integral of R_WB f + g         = change of velocity, world axes                                     (2)
//   integral of v                  = change of position                                                 (3)
//   mean of f                      = R_WB^T (change of velocity / window - g), body axes                (4)
//
// The median of f itself points up, -g along z: a multirotor carries its weight by thrust along -z.
#include "ident/flight/checks/sensor_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "ident/core/parallel.h"
#include "ident/core/statistics.h"
#include "ident/flight/conditioning/motion_tracks.h"
#include "ident/flight/conditioning/windowed_changes.h"

namespace ident {
namespace {

constexpr double kAgainst = -0.7;             ///< correlation at which an axis runs backwards
constexpr double kOther = 0.75;               ///< correlation with another axis that makes it that axis
constexpr double kOwn = 0.45;                 ///< correlation with its own axis below which it is not its own
constexpr std::size_t kFewFrameWindows = 40;  ///< too few to judge

/// Two streams of an arc that should change alike.
struct Streams {
  Track3 seen, told;
};
using MakeStreams = std::function<Streams(const FlightArc&)>;
/// What is made of the changes of `seen`, where they are not compared as they are.
using ReadChanges = std::function<void(const FlightArc&, const ChangeWindows&, Track3&)>;

/// Over all arcs, at the shift between the two streams at which they are most alike.
struct Agreement {
  Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  ///< of seen on told
};

using Sums3 = std::array<RunningSum, 3>;

Track3 changes_of(const Sums3& x, const ChangeWindows& windows, long shift) {
  return {changes(x[0], windows, shift), changes(x[1], windows, shift), changes(x[2], windows, shift)};
}

Agreement agreement(const FlightRecord& record, double lag, const MakeStreams& make,
                    const ReadChanges& read = {}) {
  const ChangeWindows windows = change_windows(lag, record.interval);
  Track3 seen;
  std::vector<Sums3> streams;
  for (const FlightArc& arc : record.arcs) {
    if (arc.rows() < 2) continue;
    const Streams both = make(arc);
    Track3 one = changes_of({both.seen[0], both.seen[1], both.seen[2]}, windows, 0);
    if (read) read(arc, windows, one);
    append(seen, one), streams.push_back({both.told[0], both.told[1], both.told[2]});
  }
  if (seen[0].size() < kFewFrameWindows) return {};
  std::array<Agreement, 5> at_shift;
  in_parallel(at_shift.size(), [&](std::size_t s) {
    const long shift = (static_cast<long>(s) - 2) * static_cast<long>(windows.margin) / 2;
    Track3 told;
    for (const Sums3& one : streams) append(told, changes_of(one, windows, shift));
    const Eigen::Matrix3d c = at_shift[s].c = correlations(seen, told);
    for (std::size_t k = 0; k < 3; ++k) {
      const double scale = mad_scale(told[k]);
      const auto i = static_cast<Eigen::Index>(k);
      at_shift[s].slope[i] = scale > 0 ? c(i, i) * mad_scale(seen[k]) / scale : 0.0;
    }
  });
  return *std::ranges::max_element(at_shift, {}, [](const Agreement& a) { return a.c.norm(); });
}

Eigen::Vector3d at(const Track3& x, std::size_t i) { return {x[0][i], x[1][i], x[2][i]}; }

Streams turns(const FlightArc& arc) { return {turn_of_attitude(arc), turn_of_rates(arc)}; }  // (1)

Streams positions(const FlightArc& arc) {  // (3)
  return {position_W(arc), integrals(arc, velocity_W(arc))};
}

// (4), times the length of a window: changes of velocity, less what gravity does, in body axes.
void in_body_axes(const FlightArc& arc, const ChangeWindows& windows, double gravity, Track3& seen) {
  for (std::size_t j = 0; j < seen[0].size(); ++j) {
    const std::size_t from = windows.margin + j * windows.stride, to = from + windows.lag;
    Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
    for (std::size_t i = from + windows.width / 2; i < to + windows.width / 2; ++i)
      R += rotation(arc.body[i].q_WB) / static_cast<double>(windows.lag);
    const Eigen::Vector3d f =
        R.transpose() * (at(seen, j) - gravity * (arc.t[to] - arc.t[from]) * Eigen::Vector3d::UnitZ());
    for (std::size_t k = 0; k < 3; ++k) seen[k][j] = f[static_cast<Eigen::Index>(k)];
  }
}

struct Agreements {
  Agreement turns, positions, velocities, forces;  ///< (1), (3), (2), (4)
};

/// Of all that was logged, whether or not it comes to be asked for.
Agreements agreements_of(const FlightRecord& record, double gravity) {
  const Signals& s = record.signals;
  const bool felt = s.force && s.attitude && (s.velocity || s.position);
  const auto velocities = [&](const FlightArc& arc) {
    return Streams{velocity_W(arc), velocity_of_force(arc, gravity)};
  };
  const auto forces = [](const FlightArc& arc) {
    return Streams{velocity_W(arc), integrals(arc, specific_force(arc))};
  };
  const auto in_body = [&](const FlightArc& arc, const ChangeWindows& windows, Track3& seen) {
    in_body_axes(arc, windows, gravity, seen);
  };
  Agreements out;
  const std::array<std::function<void()>, 4> parts = {[&] {
                                                        if (felt)
                                                          out.forces =
                                                              agreement(record, 0.4, forces, in_body);
                                                      },
                                                      [&] {
                                                        if (felt)
                                                          out.velocities = agreement(record, 0.3, velocities);
                                                      },
                                                      [&] {
                                                        if (s.rates && s.attitude)
                                                          out.turns = agreement(record, 0.15, turns);
                                                      },
                                                      [&] {
                                                        if (s.velocity && s.position)
                                                          out.positions = agreement(record, 0.3, positions);
                                                      }};
  in_parallel(parts.size(), [&](std::size_t part) { parts[part](); });
  return out;
}

std::vector<std::size_t> reversed(const Eigen::Matrix3d& c) {
  std::vector<std::size_t> axes;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (c(k, k) < kAgainst) axes.push_back(static_cast<std::size_t>(k));
  return axes;
}

using Names = std::array<const char*, 3>;

/// Reversed and exchanged axes of one signal against a second; both codes may apply at once.
void name_axes(const Eigen::Matrix3d& c, const Names& names, const std::string& against,
               std::vector<Warning>& findings) {
  std::vector<std::string> wrong;
  for (const std::size_t k : reversed(c)) wrong.emplace_back(names[k]);
  if (!wrong.empty())
    findings.push_back({"sign_flipped", fmt::format("{}: runs against {}: reverse its sign, or correct the "
                                                    "frames in a map file, and run again",
                                                    fmt::join(wrong, ", "), against)});
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = a + 1; b < 3; ++b)
      if (std::abs(c(a, b)) > kOther && std::abs(c(b, a)) > kOther &&
          std::max(std::abs(c(a, a)), std::abs(c(b, b))) < kOwn)
        findings.push_back(
            {"axes_swapped",
             fmt::format("{} and {}: each follows the other's axis of {}: exchange the two columns{}",
                         names[static_cast<std::size_t>(a)], names[static_cast<std::size_t>(b)], against,
                         c(a, b) < 0 || c(b, a) < 0 ? ", and mind the sign" : "")});
}

/// The same for a signal in world axes, where known frames have names.
void name_world(const Eigen::Matrix3d& c, const Names& names, const std::string& against,
                std::vector<Warning>& findings) {
  const bool up = c(2, 2) < kAgainst;
  const bool exchanged = c(0, 1) > kOther && c(1, 0) > kOther && std::max(c(0, 0), c(1, 1)) < kOwn;
  const bool west = c(0, 0) > kOwn && c(1, 1) < kAgainst;
  if (up && (exchanged || west))
    findings.push_back({"wrong_frame", fmt::format("{}: against {} they are {}, not north, east, down: state "
                                                   "'frames: {{world: {}}}' in a map file",
                                                   fmt::join(names, ", "), against,
                                                   exchanged ? "east, north, up" : "north, west, up",
                                                   exchanged ? "enu" : "nwu")});
  else
    name_axes(c, names, against, findings);
}

void test_gravity(const FlightRecord& record, double gravity, std::vector<Warning>& findings) {
  Track3 f;
  Track down;
  for (const FlightArc& arc : record.arcs) {
    const Track3 one = specific_force(arc);
    append(f, one);
    for (std::size_t i = 0; i < arc.rows() && record.signals.attitude; ++i)
      down.push_back((rotation(arc.body[i].q_WB) * at(one, i))[2]);
  }
  constexpr Names names{"ax", "ay", "az"};
  std::array<double, 3> middle{median(f[0]), median(f[1]), median(f[2])};
  const auto carrier = static_cast<std::size_t>(
      std::ranges::max_element(middle, {}, [](double v) { return std::abs(v); }) - middle.begin());
  if (std::abs(middle[carrier]) > 0.6 * gravity && (carrier != 2 || middle[2] > 0)) {
    findings.push_back(
        {"wrong_frame",
         fmt::format("{}: carries gravity ({:+.1f} m/s^2 mostly), but in flight a specific force "
                     "is {:.1f} along az: correct the body frame or the column's sign in a map "
                     "file",
                     names[carrier], middle[carrier], -gravity)});
  } else if (!down.empty() && median(down) > 0.5 * gravity) {
    findings.push_back(
        {"wrong_frame",
         "attitude: turns the specific force upside down: it belongs to other body or world axes "
         "(FLU, ENU); state them under 'frames' in a map file"});
  }
}

}  // namespace

SensorFrames test_sensor_frames(const FlightRecord& record, double gravity) {
  SensorFrames out;
  const Signals& s = record.signals;
  const Agreements found = agreements_of(record, gravity);
  if (s.force) test_gravity(record, gravity, out.findings);
  if (s.rates && s.attitude) {
    const Eigen::Matrix3d& c = found.turns.c;
    out.rates_confirmed = c.diagonal().minCoeff() > 0.5;
    if (reversed(c).size() == 3)
      out.findings.push_back(
          {"wrong_frame",
           "attitude: turns against the rates about all axes: it is that of the world in the "
           "body; conjugate it"});
    else
      name_axes(c, {"p", "q", "r"}, "the attitude", out.findings);
  }
  const bool moves = s.velocity || s.position;
  if (!out.findings.empty() || !moves) return out;  // what follows relies on attitude and gravity
  const Names moving = s.velocity ? Names{"vx", "vy", "vz"} : Names{"x", "y", "z"};
  if (s.velocity && s.position) name_world(found.positions.c, {"x", "y", "z"}, "the velocity", out.findings);
  if (!s.force || !s.attitude) return out;
  const std::size_t before = out.findings.size();
  name_world(found.velocities.c, moving, "the specific force", out.findings);
  if (out.findings.size() > before) return out;
  for (Eigen::Index k = 0; k < 2; ++k)  // az has its gravity
    if (found.forces.c(k, k) < kAgainst && found.forces.slope[k] < -0.4 && found.forces.slope[k] > -2.5)
      out.findings.push_back(
          {"sign_flipped", fmt::format("a{}: runs against the acceleration that the velocity "
                                       "and attitude show: reverse its sign in a map file",
                                       k == 0 ? 'x' : 'y')});
  return out;
}

}  // namespace ident
