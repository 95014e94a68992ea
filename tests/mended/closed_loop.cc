// Forces, motors, battery, gusts and sensors are the withheld simulator's; here they meet another controller.
#include "closed_loop.h"

#include <algorithm>
#include <cmath>

namespace mended {

using Eigen::Quaterniond;
using withheld::Four;
using withheld::Motion;

namespace {

constexpr double kStep = 5e-4;    // s, of integration
constexpr double kPeriod = 4e-3;  // s, of control
constexpr double kSettled = 6;    // s, of hover before errors count
constexpr double kLost = 15;      // m from the reference
constexpr double kCharge = 0.8;   // of the battery at the start

using State = Eigen::Matrix<double, 23, 1>;  // p v q(wxyz) w Omega dOmega charge polarisation

Motion motion_of(const State& x) {
  return {x.segment<3>(0), x.segment<3>(3), Quaterniond(x[6], x[7], x[8], x[9]).normalized(),
          x.segment<3>(10)};
}

class TrueVehicle {
 public:
  TrueVehicle(const Case& c, const withheld::Gusts& gusts)
      : v_(c.vehicle), e_(c.effects), body_(c.vehicle, c.effects), battery_(c.vehicle), gusts_(gusts) {}

  withheld::Acceleration acceleration(double t, const State& x) const {
    const Motion motion = motion_of(x);
    const withheld::Air air{gusts_.at(t), 0};
    withheld::Wrench sum = withheld::rotor_wrench(v_, e_, motion, air, x.segment<4>(13), x.segment<4>(17));
    const withheld::Wrench airframe = withheld::body_wrench(v_, e_, motion, air);
    sum.F += airframe.F, sum.M += airframe.M;
    return withheld::accelerate(body_, sum, motion.w);
  }

  double voltage(const State& x) const {
    return battery_.voltage({x[21], x[22]}, battery_.current(x.segment<4>(13)));
  }

  State slope(double t, const State& x, const Four& target) const {
    const Motion motion = motion_of(x);
    const withheld::Acceleration a = acceleration(t, x);
    const Quaterniond q(x[6], x[7], x[8], x[9]);
    const Quaterniond dq = q * Quaterniond(0, motion.w.x(), motion.w.y(), motion.w.z());
    const auto charge = battery_.slope({x[21], x[22]}, battery_.current(x.segment<4>(13)));
    State dx;
    dx << motion.v, motion.q * a.f + Vector3d(0, 0, v_.gravity), 0.5 * Four(dq.w(), dq.x(), dq.y(), dq.z()),
        a.dw, x.segment<4>(17),
        withheld::rotor_acceleration(v_, e_, target, x.segment<4>(13), x.segment<4>(17)), charge.left,
        charge.polarisation;
    return dx;
  }

  State step(double t, const State& x, const Four& target, double h) const {
    const State k1 = slope(t, x, target), k2 = slope(t + h / 2, x + h / 2 * k1, target),
                k3 = slope(t + h / 2, x + h / 2 * k2, target), k4 = slope(t + h, x + h * k3, target);
    State next = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    next.segment<4>(6).normalize();
    return next;
  }

  State hovering(const Vector3d& p) const {
    State x = State::Zero();
    x.segment<3>(0) = p, x[6] = 1;
    x.segment<4>(13).setConstant(v_.hover_speed());
    const withheld::Charge charge = battery_.settled(kCharge);
    x[21] = charge.left, x[22] = charge.polarisation;
    return x;
  }

  // Over one period under commands already sent; `past` gets the motion of every step.
  State play(double t, State x, const withheld::Commands& sent, double period, double reference_voltage,
             std::vector<std::pair<double, Motion>>* past) const {
    const int steps = static_cast<int>(std::ceil(period / kStep - 1e-9));
    const double h = period / steps;
    const double gain = withheld::speed_per_command(v_, e_, voltage(x) / reference_voltage);
    for (int j = 0; j < steps; ++j) {
      const double now = t + j * h, from = now - e_.command_delay;
      x = step(now, x, gain * sent.mean(from, from + h), h);
      if (past) past->push_back({now + h, motion_of(x)});
    }
    return x;
  }

 private:
  const withheld::Vehicle& v_;
  const withheld::Effects& e_;
  withheld::Body body_;
  withheld::Battery battery_;
  const withheld::Gusts& gusts_;
};

Vector3d flipped(const Vector3d& x) { return {x.x(), -x.y(), -x.z()}; }
Quaterniond flipped(const Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

const Motion& at_time(const std::vector<std::pair<double, Motion>>& past, double t) {
  std::size_t i = past.size() - 1;
  while (i > 0 && past[i].first > t + 1e-9) --i;
  return past[i].second;
}

}  // namespace

ClosedLoop fly_references(const Case& c, const References& references, TunedController controller) {
  const withheld::Gusts gusts(c.settings.back().gusts, references.end(), withheld::Random(c.seed, 901));
  withheld::Random random(c.seed, 902);
  const Vector3d gyro_bias = random.normal3(c.instruments.gyro_bias);
  const TrueVehicle vehicle(c, gusts);
  State x = vehicle.hovering(flipped(references.at(0).p));
  withheld::Commands sent;
  std::vector<std::pair<double, Motion>> past{{-1, motion_of(x)}, {0, motion_of(x)}};
  ClosedLoop out;
  std::map<std::string, std::pair<double, int>> sums;
  double sum = 0;
  int count = 0;
  for (double t = 0; t < references.end() && !out.crashed; t += kPeriod) {
    const Motion motion = motion_of(x), late = at_time(past, t - c.effects.sensor_delay);
    const withheld::Shown shown = withheld::show(c.effects, motion, late, vehicle.acceleration(t, x));
    const Belief belief{
        flipped(Vector3d(shown.p + random.normal3(c.instruments.position))), flipped(motion.v),
        flipped(Vector3d(shown.gyro + gyro_bias + random.normal3(c.instruments.gyro))), flipped(late.q)};
    const Motors delta = controller.command(t, belief, kPeriod);
    sent.push(t, Four(delta[0], delta[1], delta[2], delta[3]));
    x = vehicle.play(t, x, sent, kPeriod, c.flights.front().reference_voltage, &past);
    if (past.size() > 2000) past.erase(past.begin(), past.begin() + 1000);

    const Aim aim = references.at(t + kPeriod);
    const Vector3d error = flipped(Vector3d(x.segment<3>(0))) - aim.p;
    const double tilt = std::acos(std::clamp((motion_of(x).q * Vector3d::UnitZ()).z(), -1.0, 1.0));
    out.steepest = std::max(out.steepest, tilt);
    out.until = t + kPeriod;
    out.crashed = !x.allFinite() || tilt > M_PI / 2 || x[2] > 0 || error.norm() > kLost;
    out.path.push_back({t + kPeriod, aim.p, flipped(Vector3d(x.segment<3>(0)))});
    if (t < kSettled) continue;
    auto& [square, samples] = sums[references.name(t + kPeriod)];
    square += error.squaredNorm(), ++samples;
    sum += error.squaredNorm(), ++count;
  }
  out.rms = count > 0 ? std::sqrt(sum / count) : NAN;
  for (const auto& [name, value] : sums) out.by_reference[name] = std::sqrt(value.first / value.second);
  return out;
}

double replay_error(const Case& c, double seconds) {
  const std::size_t log = c.flights.size() - 1;
  const withheld::Flight& flight = c.flights[log];
  // The stream of the withheld simulator's gusts for this flight.
  const withheld::Gusts gusts(c.settings[log].gusts, c.settings[log].plan.duration,
                              withheld::Random(c.seed, 100 + 10 * log + 1));
  const TrueVehicle vehicle(c, gusts);
  const std::size_t first = flight.truth.size() / 2;
  State x = vehicle.hovering(Vector3d::Zero());
  const withheld::Instant& from = flight.truth[first];
  x.segment<3>(0) = from.motion.p, x.segment<3>(3) = from.motion.v;
  x.segment<4>(6) << from.motion.q.w(), from.motion.q.x(), from.motion.q.y(), from.motion.q.z();
  x.segment<3>(10) = from.motion.w, x.segment<4>(13) = from.spin.Omega, x.segment<4>(17) = from.spin.dOmega;
  double most = 0;
  for (std::size_t k = first; k + 1 < flight.truth.size() && flight.truth[k].t < from.t + seconds; ++k) {
    const withheld::Instant &now = flight.truth[k], &next = flight.truth[k + 1];
    const double volts = vehicle.voltage(x);  // charge is not among the truth: taken out of the gain
    x = vehicle.play(now.t, x, flight.commands, next.t - now.t,
                     flight.reference_voltage * volts / now.voltage, nullptr);
    most =
        std::max({most, (x.segment<3>(3) - next.motion.v).norm(), (x.segment<3>(10) - next.motion.w).norm()});
  }
  return most;
}

}  // namespace mended
