// Moves along polynomials of ninth order, which start and end with no velocity, acceleration, jerk and snap.
#include "references.h"

#include <algorithm>
#include <cmath>

namespace mended {

using Eigen::Vector3d;

namespace {

constexpr double kSettle = 6;  // s of hover before anything counts

struct Step {
  double x, dx, ddx;
};
// 126 s^5 - 420 s^6 + 540 s^7 - 315 s^8 + 70 s^9
Step smooth_step(double t, double length) {
  if (t <= 0) return {0, 0, 0};
  if (t >= length) return {1, 0, 0};
  const double s = t / length, r = 1 - s, s3 = s * s * s, r3 = r * r * r;
  const double x = s3 * s * s * (126 + s * (-420 + s * (540 + s * (-315 + 70 * s))));
  return {x, 630 * s3 * s * r3 * r / length, 2520 * s3 * r3 * (1 - 2 * s) / (length * length)};
}

}  // namespace

References::References(double bandwidth) {
  const double quick = std::clamp(bandwidth / 7, 0.3, 1.0);
  const double strong = 4.0 * (0.35 + 0.65 * quick);  // m/s^2 at most
  // The largest acceleration of a move is 9.37 times its length over the square of its time.
  const auto time_for = [&](double length) {
    return std::max(std::sqrt(9.37 * length / strong), 8 / bandwidth);
  };
  const Vector3d start = place_;
  add("settle", kSettle, [start](double) { return Aim{start}; });
  const double side = 0.6 + 0.9 * quick, rest = 1.2;
  for (const Vector3d& by : {Vector3d(side, 0, 0), Vector3d(0, -side, 0), Vector3d(-side, side, 0),
                             Vector3d(0, 0, 0.7 * side), Vector3d(0, 0, -0.7 * side)})
    add_move("steps", by, time_for(by.norm()), rest);
  const double size = 1.6;
  add_eight(size, std::min(std::sqrt(0.6 * strong / (2 * size)), 0.35 * bandwidth));
  const double far = 6 + 8 * quick;
  for (const double way : {far, -far}) add_move("straight", Vector3d(way, 0, 0), time_for(far), rest);
}

void References::add(const std::string& name, double length, Shape shape) {
  const double start = segments_.empty() ? 0 : segments_.back().end;
  place_ = shape(length).p;
  segments_.push_back({name, start, start + length, std::move(shape)});
}

void References::add_move(const std::string& name, const Vector3d& by, double length, double rest) {
  add(name, length + rest, [=, from = place_](double t) {
    const Step s = smooth_step(t, length);
    return Aim{from + s.x * by, s.dx * by, s.ddx * by};
  });
}

// Two rounds; the phase gathers speed and loses it like a smooth step.
void References::add_eight(double size, double rate) {
  const double angle = 4 * M_PI, length = 1.25 * angle / rate, rest = 1.2;
  add("figure eight", length + rest, [=, from = place_](double t) {
    const double gather = 0.2 * length;
    // Trapezoid of angular speed with smooth flanks: integral of the step up less that of the step down.
    const double top = angle / (length - gather);
    const auto flank = [&](double since) -> Step {
      const double s = std::clamp(since / gather, 0.0, 1.0);
      const double integral = gather * std::pow(s, 6) * (21 + s * (-60 + s * (67.5 + s * (-35 + 7 * s))));
      const Step step = smooth_step(since, gather);
      return {integral + std::max(0.0, since - gather), step.x, step.dx};
    };
    const Step up = flank(t), down = flank(t - length + gather);
    const double phi = top * (up.x - down.x), w = top * (up.dx - down.dx), dw = top * (up.ddx - down.ddx);
    const Vector3d along(1, 0, 0), beside(0, 1, 0);
    const double s = std::sin(phi), c = std::cos(phi), s2 = std::sin(2 * phi), c2 = std::cos(2 * phi);
    Aim aim{from + size * (s * along + 0.5 * s2 * beside)};
    aim.v = size * w * (c * along + c2 * beside);
    aim.a = size * (w * w * (-s * along - 2 * s2 * beside) + dw * (c * along + c2 * beside));
    return aim;
  });
}

Aim References::at(double t) const {
  for (const Segment& segment : segments_)
    if (t < segment.end) return segment.shape(t - segment.start);
  return Aim{place_};
}

const std::string& References::name(double t) const {
  for (const Segment& segment : segments_)
    if (t < segment.end) return segment.name;
  return segments_.back().name;
}

}  // namespace mended
