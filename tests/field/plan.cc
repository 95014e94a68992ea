// Draws manoeuvres and gives their set-points.
#include "plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace field {
namespace {

using std::numbers::pi;
using Offset = std::function<SetPoint(double)>;

struct Manoeuvre {
  std::string name;
  double length;
  Offset offset;
};

// Distance, speed and acceleration at t of a trapezoid of speed.
struct Along {
  double s, v, a;
};
Along trapezoid(double t, double speed, double ramp, double cruise) {
  const double a = speed / ramp;
  if (t < ramp) return {0.5 * a * t * t, a * t, a};
  if (t < ramp + cruise) return {speed * (t - 0.5 * ramp), speed, 0};
  const double left = std::max(0.0, 2 * ramp + cruise - t);
  return {speed * (ramp + cruise) - 0.5 * a * left * left, a * left, left > 0 ? -a : 0};
}

SetPoint along(const Vector3d& direction, const Along& x) {
  return {.p_W = x.s * direction, .v_W = x.v * direction, .a_W = x.a * direction};
}

Manoeuvre hover(Random& random) {
  return {"hover", random.uniform(2, 4), [](double) { return SetPoint{}; }};
}

Manoeuvre step(Random& random, const FlightLimits& limits) {
  const double angle = random.uniform(0, 2 * pi), size = random.uniform(0.2, 0.5) * limits.room;
  const Vector3d to(size * std::cos(angle), size * std::sin(angle), random.uniform(-0.15, 0) * size);
  return {"step", 3.0, [to](double) { return SetPoint{.p_W = to}; }};
}

Manoeuvre eight(Random& random, const FlightLimits& limits) {
  const double period = std::max(3.0, 2 * pi * 0.5 * limits.room / (random.uniform(0.5, 0.9) * limits.speed));
  const double A = 0.5 * limits.room, w = 2 * pi / period, heading = random.uniform(0, pi);
  const double length = 2.5 * period > 14 ? 14 : 2.5 * period;
  return {"eight", length, [=](double t) {
            const auto place = [=](double s) {
              const double in = std::clamp(s / 2, 0.0, 1.0), out = std::clamp((length - s) / 2, 0.0, 1.0);
              const double share = in * in * (3 - 2 * in) * out * out * (3 - 2 * out);
              const double x = A * std::sin(w * s), y = 0.5 * A * std::sin(2 * w * s);
              return Vector3d(share * (std::cos(heading) * x - std::sin(heading) * y),
                              share * (std::sin(heading) * x + std::cos(heading) * y), 0);
            };
            const double h = 1e-3;
            const Vector3d before = place(t - h), now = place(t), after = place(t + h);
            return SetPoint{now, (after - before) / (2 * h), (after - 2 * now + before) / (h * h)};
          }};
}

Manoeuvre dash(Random& random, const FlightLimits& limits) {
  const double speed = limits.speed * random.uniform(0.7, 1.0);
  const double ramp = speed / random.uniform(2.0, 4.0), cruise = random.uniform(1.0, 2.5);
  const double angle = random.uniform(0, 2 * pi);
  const Vector3d direction(std::cos(angle), std::sin(angle),
                           random.chance(0.3) ? random.uniform(-0.2, 0) : 0);
  const double half = 2 * ramp + cruise;
  return {"dash", 2 * half + 0.5, [=](double t) {
            if (t < half) return along(direction, trapezoid(t, speed, ramp, cruise));
            SetPoint back = along(-direction, trapezoid(t - half, speed, ramp, cruise));
            back.p_W += direction * trapezoid(half, speed, ramp, cruise).s;
            return back;
          }};
}

Manoeuvre climb(Random& random, const FlightLimits& limits) {
  const double up = limits.climb * random.uniform(0.5, 1), down = limits.sink * random.uniform(0.5, 1);
  const double rise = std::max(0.3, up / 4), cruise = random.uniform(0.8, 2);
  const double height = up * (rise + cruise), top = 2 * rise + cruise;
  const double fall = std::max(0.3, down / 4), sinking = std::max(0.1, height / down - fall);
  const double speed = height / (fall + sinking);
  return {"climb", top + 0.5 + 2 * fall + sinking + 0.5, [=](double t) {
            const Vector3d upward(0, 0, -1);
            if (t < top + 0.5) return along(upward, trapezoid(t, up, rise, cruise));
            SetPoint back = along(-upward, trapezoid(t - top - 0.5, speed, fall, sinking));
            back.p_W += height * upward;
            return back;
          }};
}

Manoeuvre turn(Random& random) {
  const double angle = random.sign() * random.uniform(pi / 2, 2 * pi), rate = random.uniform(0.8, 2.0);
  const double length = std::abs(angle) / rate;
  return {"yaw", length + 0.7, [=](double t) {
            const bool turning = t < length;
            return SetPoint{.yaw = turning ? angle * t / length : angle,
                            .yaw_rate = turning ? angle / length : 0};
          }};
}

Manoeuvre doublets(Random& random, const FlightLimits& limits) {
  const double half = random.uniform(0.2, 0.45), size = limits.tilt * random.uniform(0.6, 1);
  const double pause = random.uniform(0.6, 1.0), one = 2 * half + pause;
  const int first = random.integer(0, 1);
  const double yaw = random.uniform(0.3, 0.8);
  return {"doublets", 5 * one, [=](double t) {
            const int number = static_cast<int>(t / one);
            const double s = t - number * one;
            const double value = s < half ? 1 : s < 2 * half ? -1 : 0;
            SetPoint p;
            if (number == 4) {
              p.yaw = yaw * (s < half ? s / half : s < 2 * half ? 2 - s / half : 0);
            } else {
              p.tilt_B[(number + first) % 2] = size * value;
            }
            return p;
          }};
}

// Down to `low` and twice of it, and back.
Manoeuvre low_pass(const FlightLimits& limits) {
  const double drop = limits.height - limits.low, down = drop / (0.6 + 0.5), raise = limits.low;
  const double first = 1.7, hold = 3.0, second = 1.0;
  return {"low", 2 * (first + hold) + second, [=](double t) {
            const Vector3d downward(0, 0, 1);
            if (t < first + hold) return along(downward, trapezoid(t, down, 0.6, 0.5));
            SetPoint p;
            if (t < first + 2 * hold) {
              p = along(-downward, trapezoid(t - first - hold, raise / 0.7, 0.5, 0.2));
              p.p_W += drop * downward;
              return p;
            }
            const double left = drop - raise;
            p = along(-downward, trapezoid(t - first - 2 * hold, left / (0.6 + 0.5), 0.6, 0.5));
            p.p_W += left * downward;
            return p;
          }};
}

Manoeuvre draw_manoeuvre(Random& random, const FlightLimits& limits, int style) {
  const double x = random.uniform(0, 1);
  if (style == 0) {  // about hover: steps and doublets
    return x < 0.3    ? doublets(random, limits)
           : x < 0.55 ? step(random, limits)
           : x < 0.75 ? climb(random, limits)
           : x < 0.9  ? turn(random)
                      : hover(random);
  }
  if (style == 1) {  // fast
    return x < 0.4    ? dash(random, limits)
           : x < 0.7  ? eight(random, limits)
           : x < 0.85 ? climb(random, limits)
                      : doublets(random, limits);
  }
  return x < 0.2    ? dash(random, limits)
         : x < 0.4  ? eight(random, limits)
         : x < 0.55 ? climb(random, limits)
         : x < 0.7  ? step(random, limits)
         : x < 0.85 ? doublets(random, limits)
                    : turn(random);
}

}  // namespace

void FlightPlan::add(std::string name, double length, Offset offset) {
  SetPoint start{.p_W = Vector3d(0, 0, 0)};
  double from = 0;
  if (!segments_.empty()) {
    const Segment& last = segments_.back();
    from = last.from + last.length;
    start = at(from);
    start.v_W.setZero();
    start.a_W.setZero();
    start.tilt_B.setZero();
    start.yaw_rate = 0;
  }
  segments_.push_back({from, length, start, std::move(offset)});
  names_.push_back(std::move(name));
}

FlightPlan::FlightPlan(Random& random, const FlightLimits& limits, double duration, int style) {
  const auto fly = [&](Manoeuvre m) { add(std::move(m.name), m.length, std::move(m.offset)); };
  const Vector3d height(0, 0, -limits.height);
  add("hover", 2, [height](double) { return SetPoint{.p_W = height}; });
  if (limits.low > 0) fly(low_pass(limits));
  fly(doublets(random, limits));
  while (segments_.back().from + segments_.back().length < duration)
    fly(draw_manoeuvre(random, limits, style));
}

SetPoint FlightPlan::at(double t) const {
  size_t i = segments_.size() - 1;
  while (i > 0 && segments_[i].from > t) --i;
  if (i > 0 && segments_[i].from >= t) --i;  // the end of a segment belongs to it
  const Segment& segment = segments_[i];
  SetPoint p = segment.offset(std::clamp(t - segment.from, 0.0, segment.length));
  p.p_W += segment.start.p_W;
  p.yaw += segment.start.yaw;
  return p;
}

}  // namespace field
