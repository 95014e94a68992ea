// Where the motors of a Betaflight quadrotor sit, and which way they turn as its flight tells.
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

/// Span over which yaw's change is compared with the motors' command [s]: longer than their lag (some 30 ms),
/// shorter than a turn.
constexpr double kSpan = 0.05;
/// Standard errors from zero at which the sign of a correlation is taken.
constexpr double kPlain = 5.0;

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

/// Yaw's changes over successive spans, and the mean yaw command within each.
struct YawSpans {
  std::vector<double> change, command;
};

YawSpans yaw_spans(const LogStreams& log) {
  YawSpans spans;
  const LogStream* main = find_stream(log, "main");
  const StreamField* yaw = main ? main->find("gyroADC[2]") : nullptr;
  std::array<const StreamField*, 4> motors{};
  for (std::size_t i = 0; main && i < 4; ++i) motors[i] = main->find(fmt::format("motor[{}]", i));
  if (!yaw || !motors[3]) return spans;
  const auto command = [&](std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += kQuadX[k].spin * motors[k]->at(i);
    return sum;
  };
  double sum = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < main->t.size(); ++i) {
    sum += command(i);
    if (main->t[i] - main->t[begin] < kSpan) continue;
    if (main->t[i] - main->t[begin] < 2 * kSpan && i > begin + 2) {
      // The log's yaw is positive to the left; a counter-clockwise rotor turns the body to the right.
      spans.change.push_back(-(yaw->at(i) - yaw->at(begin)));
      spans.command.push_back(sum / static_cast<double>(i - begin + 1));
    }
    begin = i;
    sum = 0;
  }
  return spans;
}

}  // namespace

double default_spin_correlation(const LogStreams& log) {
  const YawSpans spans = yaw_spans(log);
  if (spans.change.size() < 4) return 0.0;
  const double r = correlation(spans.change, spans.command);
  return std::abs(r) * std::sqrt(static_cast<double>(spans.change.size())) > kPlain ? r : 0.0;
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
  const std::string spin =
      r == 0.0 ? "spin ASSUMED (props in): yaw does not tell"
               : fmt::format("props {}, as yaw tells (correlation {:.2f})", r > 0 ? "in" : "out", r);
  FrameGeometry geometry{.spin_is_known = r != 0.0};
  const double side = std::round(kAssumedArm / std::sqrt(2.0) * 1e4) / 1e4;  // m
  for (const Place& place : kQuadX) {
    geometry.rotors.push_back(
        {.r_B = {place.x * side, place.y * side, 0}, .s = r < 0 ? -place.spin : place.spin});
    geometry.source.push_back(fmt::format("motor {}, {}; {}", geometry.rotors.size(), place.name, spin));
  }
  return geometry;
}

}  // namespace ident
