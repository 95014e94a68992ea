// The manoeuvres of a flight; vehicles of all sizes fly them at speeds that suit them.
#include "flight_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace withheld {

using Eigen::Vector3d;

namespace {

// From 0 to 1 with finite acceleration, with its first and second derivatives.
struct Ramp {
  double x, dx, ddx;
};
Ramp ramp(double t, double length) {
  if (t <= 0) return {0, 0, 0};
  if (t >= length) return {1, 0, 0};
  const double k = M_PI / length;
  return {0.5 * (1 - std::cos(k * t)), 0.5 * k * std::sin(k * t), 0.5 * k * k * std::cos(k * t)};
}

Vector3d horizontal(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

}  // namespace

FlightPlan::FlightPlan(const Vehicle& vehicle, const PlanSettings& settings, Random random) {
  quick_ = attitude_bandwidth(vehicle) / 7;
  cruise_ = std::clamp(4.5 * std::pow(vehicle.m / 0.3, 0.15), 2.5, 6.5) * (0.4 + 0.6 * quick_);
  rest_.p = Vector3d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -random.uniform(2.5, 4.5));
  rest_.yaw = random.uniform(-M_PI, M_PI);
  const Reference begin = rest_;
  add("hover", random.uniform(1, 2.5), [begin](double) { return begin; });

  std::vector<std::string> wanted;
  if (settings.near_ground) wanted.push_back("low pass");
  if (settings.fast_descent) wanted.push_back("descents");
  if (settings.multisine) wanted.push_back("multisine");
  if (random.chance(0.85)) wanted.push_back(random.chance(0.6) ? "forward leg" : "figure eight");
  const std::array<const char*, 10> others = {
      "multisine", "doublets",     "position steps", "vertical steps", "low pass",
      "descents",  "figure eight", "forward leg",    "turn",           "position steps"};
  while (wanted.size() < 9) wanted.push_back(others[static_cast<std::size_t>(random.integer(0, 9))]);
  const std::size_t fixed = static_cast<std::size_t>(random.integer(3, 4));
  for (std::size_t i = fixed; i > 0; --i)
    std::swap(wanted[i - 1], wanted[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  for (const std::string& name : wanted) {
    if (segments_.back().end >= settings.duration) break;
    add_named(name, vehicle, settings.liveliness, random);
  }
}

Reference FlightPlan::at(double t) const {
  for (const Segment& segment : segments_) {
    if (t < segment.end) return segment.shape(t - segment.start);
  }
  return rest_;
}

void FlightPlan::add(const std::string& name, double length, Shape shape) {
  const double start = segments_.empty() ? 0 : segments_.back().end;
  rest_ = shape(length);
  rest_.v.setZero();
  rest_.a.setZero();
  rest_.yaw_rate = 0;
  rest_.injected.setZero();
  segments_.push_back({start, start + length, std::move(shape)});
  names_.push_back(name);
}

void FlightPlan::add_named(const std::string& name, const Vehicle& v, double liveliness, Random& random) {
  if (name == "multisine") add_multisine(v, liveliness, random);
  if (name == "doublets") add_doublets(v, liveliness, random);
  if (name == "position steps") add_steps(v, liveliness, random);
  if (name == "vertical steps") add_heights(v, liveliness, random);
  if (name == "low pass") add_low_pass(v, random);
  if (name == "descents") add_descents(v, random);
  if (name == "figure eight") add_eight(liveliness, random);
  if (name == "forward leg") add_leg(liveliness, random);
  if (name == "turn") add_turn(random);
}

void FlightPlan::add_multisine(const Vehicle& v, double liveliness, Random& random) {
  constexpr int kTones = 6;
  const double highest = std::clamp(1.5 * v.omega_m / (2 * M_PI), 2.0, 10.0);
  // The tilt that the slowest tones cause against the attitude loop stays below some degrees.
  const double most = 0.005 * std::pow(7 * quick_, 2) * v.arm;
  const double rms = v.hover_command() * std::min(random.uniform(0.015, 0.04), most) * liveliness;
  Eigen::Matrix<double, kRotors, kTones> rate, phase;
  for (int i = 0; i < kRotors; ++i) {
    for (int k = 0; k < kTones; ++k) {
      rate(i, k) = 2 * M_PI * random.log_uniform(0.4, highest);
      phase(i, k) = random.uniform(0, 2 * M_PI);
    }
  }
  const double length = random.uniform(8, 14), amplitude = rms * std::sqrt(2.0 / kTones);
  add("multisine", length, [=, begin = rest_](double t) {
    Reference r = begin;
    const double fade = std::min({1.0, 2 * t, 2 * (length - t)});
    for (int i = 0; i < kRotors; ++i) {
      for (int k = 0; k < kTones; ++k)
        r.injected[i] += fade * amplitude * std::sin(rate(i, k) * t + phase(i, k));
    }
    return r;
  });
}

void FlightPlan::add_doublets(const Vehicle& v, double liveliness, Random& random) {
  const int count = random.integer(3, 5);
  const double every = random.uniform(1.6, 2.4), half = random.uniform(0.15, 0.3);
  std::vector<Four> kicks;
  for (int k = 0; k < count; ++k) {
    const Vector3d axis = Vector3d::Unit(random.integer(0, 2));
    Four kick;
    for (int i = 0; i < kRotors; ++i) {
      const Rotor& rotor = v.rotors[static_cast<std::size_t>(i)];
      const double yaw = v.layout == "4sp" ? (i % 2 == 0 ? 1.0 : -1.0) : rotor.s;
      kick[i] = axis.dot(Vector3d(-rotor.r.y() / v.arm, rotor.r.x() / v.arm, 1.6 * yaw));
    }
    // Angular acceleration of about 100 m/s^2/arm a unit of the relative command turns by at most 15 degrees.
    const double most = 0.25 * v.arm / (100 * half * half);
    kicks.push_back(kick * random.uniform(0.4, 1) * std::min(0.08, most) * v.hover_command() * liveliness *
                    random.sign());
  }
  add("doublets", every * count, [=, begin = rest_](double t) {
    Reference r = begin;
    const auto k = std::min(static_cast<std::size_t>(t / every), kicks.size() - 1);
    const double since = t - every * static_cast<double>(k);
    if (since < 2 * half) r.injected = since < half ? kicks[k] : Four(-kicks[k]);
    return r;
  });
}

void FlightPlan::add_steps(const Vehicle& v, double liveliness, Random& random) {
  const int count = random.integer(3, 5);
  const double every = random.uniform(2, 3);
  const double size = std::clamp(1.2 * std::sqrt(v.arm / 0.17), 0.6, 2.0) * liveliness * (0.4 + 0.6 * quick_);
  std::vector<Vector3d> places{rest_.p};
  for (int k = 0; k < count; ++k) {
    const Vector3d step = size * random.uniform(0.5, 1.2) * horizontal(random.uniform(0, 2 * M_PI));
    places.push_back(rest_.p + step);
  }
  add("position steps", every * count, [=, begin = rest_](double t) {
    Reference r = begin;
    r.p = places[std::min(static_cast<std::size_t>(t / every) + 1, places.size() - 1)];
    return r;
  });
}

void FlightPlan::add_heights(const Vehicle& v, double liveliness, Random& random) {
  const int count = random.integer(3, 4);
  const double every = random.uniform(2, 3), length = random.uniform(0.7, 1.4);
  const double ceiling = -(6 * v.radius + 0.8);
  std::vector<double> heights{rest_.p.z()};
  for (int k = 0; k < count; ++k) {
    const double z = rest_.p.z() + random.sign() * random.uniform(0.4, 1.2) * liveliness;
    heights.push_back(std::min(z, ceiling));
  }
  add("vertical steps", every * count, [=, begin = rest_](double t) {
    Reference r = begin;
    const auto k = std::min(static_cast<std::size_t>(t / every), heights.size() - 2);
    const Ramp x = ramp(t - every * static_cast<double>(k), length);
    const double change = heights[k + 1] - heights[k];
    r.p.z() = heights[k] + change * x.x;
    r.v.z() = change * x.dx;
    r.a.z() = change * x.ddx;
    return r;
  });
}

void FlightPlan::add_low_pass(const Vehicle& v, Random& random) {
  const double margin = 0.01 + 0.012 / (quick_ * quick_);  // m, for what gusts and noise do to the height
  const double low = v.radius * random.uniform(1.3, 2.2) + margin,
               middle = low + v.radius * random.uniform(1, 3);
  const double depth = -rest_.p.z() - low, rise = middle - low;
  const double down = random.uniform(2.5, 3.5) * (0.7 + 0.3 / quick_), stay = random.uniform(2, 3.5);
  const Vector3d drift = random.uniform(0, 0.4) * horizontal(random.uniform(0, 2 * M_PI));
  const double up = depth - rise, first = down + stay, second = first + 1 + stay;
  add("low pass", second + down, [=, begin = rest_](double t) {
    Reference r = begin;
    const Ramp a = ramp(t, down), b = ramp(t - first, 1), c = ramp(t - second, down);
    r.p.z() += depth * a.x - rise * b.x - up * c.x;
    r.v.z() += depth * a.dx - rise * b.dx - up * c.dx;
    r.a.z() += depth * a.ddx - rise * b.ddx - up * c.ddx;
    r.p += drift * t;
    r.v += drift;
    return r;
  });
}

void FlightPlan::add_descents(const Vehicle& v, Random& random) {
  const double speed = v.induced_speed() * random.uniform(0.5, 1.1);
  const double height = speed * random.uniform(1.2, 2.0), length = height / speed * M_PI / 2;
  const double climb = 1.6 * length, every = climb + length + 0.6;
  add("descents", 2 * every, [=, begin = rest_](double t) {
    Reference r = begin;
    const double since = t < every ? t : t - every;
    const Ramp a = ramp(since, climb), b = ramp(since - climb - 0.3, length);
    r.p.z() -= height * (a.x - b.x);
    r.v.z() -= height * (a.dx - b.dx);
    r.a.z() -= height * (a.ddx - b.ddx);
    return r;
  });
}

void FlightPlan::add_eight(double liveliness, Random& random) {
  const double size = random.uniform(1.5, 3.5), speed = cruise_ * liveliness * random.uniform(0.4, 0.9);
  const double rate = std::min(speed / (1.4 * size), 1.4 * quick_ + 0.2), wind_up = 2,
               turns = random.uniform(1, 2);
  const double angle = random.uniform(0, 2 * M_PI), length = turns * 2 * M_PI / rate + wind_up;
  const Vector3d along = horizontal(angle), beside = horizontal(angle + M_PI / 2);
  add("figure eight", std::min(length, 16.0), [=, begin = rest_](double t) {
    Reference r = begin;
    const double w = t < wind_up ? rate * t / wind_up : rate;
    const double dw = t < wind_up ? rate / wind_up : 0;
    const double phi = t < wind_up ? 0.5 * rate * t * t / wind_up : rate * (t - 0.5 * wind_up);
    const double s = std::sin(phi), c = std::cos(phi), s2 = std::sin(2 * phi), c2 = std::cos(2 * phi);
    r.p += size * (s * along + 0.5 * s2 * beside);
    r.v += size * w * (c * along + c2 * beside);
    r.a += size * (w * w * (-s * along - 2 * s2 * beside) + dw * (c * along + c2 * beside));
    return r;
  });
}

void FlightPlan::add_leg(double liveliness, Random& random) {
  const double speed = cruise_ * liveliness * random.uniform(0.7, 1.5),
               gather = random.uniform(1.8, 2.8) * (0.7 + 0.3 / quick_);
  const double cruise = random.uniform(0.8, 2.2), once = 2 * gather + cruise;
  const Vector3d along =
      horizontal(rest_.yaw + random.uniform(-0.4, 0.4) + (random.chance(0.3) ? M_PI / 2 : 0));
  add("forward leg", 2 * once + 0.8, [=, begin = rest_](double t) {
    Reference r = begin;
    const bool back = t > once + 0.4;
    const double since = back ? t - once - 0.4 : t;
    const Ramp a = ramp(since, gather), b = ramp(since - gather - cruise, gather);
    const auto travelled = [&](double x) {  // integral of the ramp
      if (x <= 0) return 0.0;
      if (x >= gather) return x - 0.5 * gather;
      return 0.5 * (x - gather / M_PI * std::sin(M_PI * x / gather));
    };
    const double distance = speed * (travelled(since) - travelled(since - gather - cruise));
    const double whole = speed * (once - gather);
    const double side = back ? -1 : 1;
    r.p += (back ? whole - distance : distance) * along;
    r.v += side * speed * (a.x - b.x) * along;
    r.a += side * speed * (a.dx - b.dx) * along;
    return r;
  });
}

void FlightPlan::add_turn(Random& random) {
  const double angle = random.sign() * (random.chance(0.5) ? 2 * M_PI : random.uniform(0.6, 1.6));
  const double length = std::abs(angle) / random.uniform(0.7, 1.4) * M_PI / 2;
  add("turn", length + 1, [=, begin = rest_](double t) {
    Reference r = begin;
    const Ramp a = ramp(t, length);
    r.yaw += angle * a.x;
    r.yaw_rate = angle * a.dx;
    return r;
  });
}

}  // namespace withheld
