// Where the motors of a Betaflight quadrotor sit, and which way they turn, as its flight tells.
#include "ident/io/draft/betaflight_geometry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "ident/core/error.h"
#include "ident/io/log/stream_signals.h"

namespace ident {
namespace {

struct Place {
  const char* name;
  double x, y;  ///< signs, forward and right
  int spin;     ///< by default, +1 counter-clockwise from above
};
/// [Betaflight, mixer_init.c: mixerQuadX].
constexpr std::array<Place, 4> kQuadX = {{{"rear right", -1, 1, -1},
                                          {"front right", 1, 1, 1},
                                          {"rear left", -1, -1, 1},
                                          {"front left", 1, -1, -1}}};

/// Correlation from which its sign is taken. Commands that are clipped or limited keep it above, noise stays
/// below.
constexpr double kPlain = 0.3;
constexpr std::size_t kFewest = 100;  // samples

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double sa = 0, sb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sa += a[i], sb += b[i];
  double saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = a[i] - sa / n, db = b[i] - sb / n;
    saa += da * da, sbb += db * db, sab += da * db;
  }
  return saa > 0 && sbb > 0 ? sab / std::sqrt(saa * sbb) : 0.0;
}

/// Yaw torque, positive to the right: what is asked for, and what default spins would make of the commands.
struct YawTorque {
  std::vector<double> asked, commanded;
};

YawTorque yaw_torque(const LogStreams& log) {
  YawTorque torque;
  const LogStream* main = find_stream(log, "main");
  std::array<const StreamField*, 4> motors{};
  for (std::size_t i = 0; main && i < 4; ++i) motors[i] = main->find(fmt::format("motor[{}]", i));
  std::vector<const StreamField*> terms;
  for (const char* term : {"axisP[2]", "axisI[2]", "axisD[2]", "axisF[2]"})
    if (const StreamField* field = main ? main->find(term) : nullptr) terms.push_back(field);
  if (terms.empty() || !motors[3]) return torque;
  for (std::size_t i = 0; i < main->t.size(); ++i) {
    double asked = 0, commanded = 0;
    for (const StreamField* term : terms)
      asked -= term->at(i);  // the controller's yaw is positive to the left
    // A counter-clockwise rotor turns the body to the right.
    for (std::size_t k = 0; k < 4; ++k) commanded += kQuadX[k].spin * motors[k]->at(i);
    torque.asked.push_back(asked);
    torque.commanded.push_back(commanded);
  }
  return torque;
}

}  // namespace

double default_spin_correlation(const LogStreams& log) {
  const YawTorque torque = yaw_torque(log);
  if (torque.asked.size() < kFewest) return 0.0;
  const double r = correlation(torque.asked, torque.commanded);
  return std::abs(r) > kPlain ? r : 0.0;
}

FrameGeometry betaflight_geometry(const LogStreams& log) {
  const LogStream* main = find_stream(log, "main");
  int motors = 0;
  while (main && main->find(fmt::format("motor[{}]", motors))) ++motors;
  if (motors != 4)
    throw DataError(
        fmt::format("{}: logs {} motors: where they sit is known for Betaflight's quad X alone; write the "
                    "vehicle file by hand",
                    log.file, motors));
  const double r = default_spin_correlation(log);
  const std::string spin = r == 0.0
                               ? "spin ASSUMED (props in): the log does not tell"
                               : fmt::format("props {}, as the yaw controller uses them (correlation {:.2f})",
                                             r > 0 ? "in" : "out", r);
  FrameGeometry geometry{.spin_is_known = r != 0.0};
  const double side = std::round(kAssumedArm / std::sqrt(2.0) * 1e5) / 1e5;  // m
  for (const Place& place : kQuadX) {
    geometry.rotors.push_back(
        {.r_B = {place.x * side, place.y * side, 0}, .s = r < 0 ? -place.spin : place.spin});
    geometry.source.push_back(fmt::format("motor {}, {}; {}", geometry.rotors.size(), place.name, spin));
  }
  return geometry;
}

}  // namespace ident
