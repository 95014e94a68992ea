// Fourth-order Runge-Kutta at half a millisecond; the command is held from one row of the log to the next.
#include "simulate.h"

#include <algorithm>
#include <cmath>

namespace withheld {

using Eigen::Vector3d;

namespace {

using State = Eigen::Matrix<double, 35, 1>;  // p v q(wxyz) w Omega dOmega aux charge polarisation

Motion motion_of(const State& x) {
  return {x.segment<3>(0), x.segment<3>(3), Eigen::Quaterniond(x[6], x[7], x[8], x[9]), x.segment<3>(10)};
}

struct Slope {
  State dx;
  Acceleration acceleration;
};

class World {
 public:
  World(const Vehicle& v, const Effects& e, const FlightSettings& settings, std::uint64_t seed, int index)
      : v_(v),
        e_(e),
        body_(v, e),
        battery_(v),
        gusts_(settings.gusts, settings.plan.duration, Random(seed, stream(index, 1))),
        bursts_(v, settings.plan.duration, Random(seed, stream(index, 2))) {}

  static std::uint64_t stream(int index, int purpose) {
    return 100 + static_cast<std::uint64_t>(10 * index + purpose);
  }

  Air air(double t) const {
    const bool rough = e_.vortex_ring > 0 || e_.downwash > 0;
    return {gusts_.at(t), rough ? gusts_.vortex_noise(t) : 0.0};
  }
  Battery& battery() { return battery_; }

  double voltage(const State& x) const {
    return battery_.voltage({x[33], x[34]}, battery_.current(x.segment<4>(13)));
  }

  Slope slope(double t, const State& x, const Four& target) const {
    Motion motion = motion_of(x);
    motion.q.normalize();
    const Four Omega = x.segment<4>(13), dOmega = x.segment<4>(17);
    const Aux aux = x.segment<12>(21);
    const Air here = air(t);
    Aux aux_slope = Aux::Zero();
    Wrench wrench;
    if (e_.arm_flex > 0) {
      Four thrust;
      rotor_wrench(v_, e_, motion, here, Omega, dOmega, &thrust);
      const Four passed = transmitted_thrust(e_, thrust, aux, &aux_slope);
      wrench = rotor_wrench(v_, e_, motion, here, Omega, dOmega, nullptr, &passed);
    } else {
      wrench = rotor_wrench(v_, e_, motion, here, Omega, dOmega);
    }
    add(body_wrench(v_, e_, motion, here), 1, wrench);
    if (e_.downwash > 0) add(bursts_.at(t, here.vortex_noise), e_.downwash, wrench);
    const Memory memory = remember(v_, e_, motion, Omega, wrench, aux);
    add(memory.wrench, 1, wrench);
    aux_slope += memory.slope;

    Slope result;
    result.acceleration = accelerate(body_, wrench, motion.w);
    State& dx = result.dx;
    dx.segment<3>(0) = motion.v;
    dx.segment<3>(3) = motion.q * result.acceleration.f + Vector3d(0, 0, v_.gravity);
    const Eigen::Quaterniond dq = motion.q * Eigen::Quaterniond(0, motion.w.x(), motion.w.y(), motion.w.z());
    dx.segment<4>(6) = 0.5 * Four(dq.w(), dq.x(), dq.y(), dq.z());
    dx.segment<3>(10) = result.acceleration.dw;
    dx.segment<4>(13) = dOmega;
    dx.segment<4>(17) = rotor_acceleration(v_, e_, target, Omega, dOmega);
    dx.segment<12>(21) = aux_slope;
    const Charge charge = battery_.slope({x[33], x[34]}, battery_.current(Omega));
    dx[33] = charge.left;
    dx[34] = charge.polarisation;
    return result;
  }

  State step(double t, const State& x, const Four& target, double h) const {
    const State k1 = slope(t, x, target).dx;
    const State k2 = slope(t + 0.5 * h, x + 0.5 * h * k1, target).dx;
    const State k3 = slope(t + 0.5 * h, x + 0.5 * h * k2, target).dx;
    const State k4 = slope(t + h, x + h * k3, target).dx;
    State next = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    next.segment<4>(6).normalize();
    return next;
  }

  State start(const Reference& reference, double charge) const {
    State x = State::Zero();
    x.segment<3>(0) = reference.p;
    x[6] = std::cos(reference.yaw / 2);
    x[9] = std::sin(reference.yaw / 2);
    x.segment<4>(13).setConstant(v_.hover_speed());
    x.segment<12>(21) = settled_aux(v_, e_, motion_of(x));
    const Charge settled = battery_.settled(charge);
    x[33] = settled.left;
    x[34] = settled.polarisation;
    return x;
  }

 private:
  static void add(const Wrench& part, double size, Wrench& sum) {
    sum.F += size * part.F;
    sum.M += size * part.M;
  }

  const Vehicle& v_;
  const Effects& e_;
  Body body_;
  Battery battery_;
  Gusts gusts_;
  Bursts bursts_;
};

// The motion at every integration step of the recent past, for sensors that show it late.
class Past {
 public:
  void push(double t, const Motion& motion) {
    kept_.push_back({t, motion});
    if (kept_.size() > 400) kept_.erase(kept_.begin(), kept_.begin() + 200);
  }
  Motion at(double t) const {
    std::size_t i = kept_.size() - 1;
    while (i > 0 && kept_[i - 1].first > t) --i;
    if (i == 0) return kept_.front().second;
    const auto& [t0, a] = kept_[i - 1];
    const auto& [t1, b] = kept_[i];
    const double s = std::clamp((t - t0) / (t1 - t0), 0.0, 1.0);
    return {a.p + s * (b.p - a.p), a.v + s * (b.v - a.v), a.q.slerp(s, b.q), a.w + s * (b.w - a.w)};
  }

 private:
  std::vector<std::pair<double, Motion>> kept_;
};

Shown with_noise(Shown s, const Instruments& i, const Vector3d& gyro_bias, Random& random) {
  s.gyro += gyro_bias + random.normal3(i.gyro);
  s.acc += random.normal3(i.acc);
  s.q = s.q * small_turn(random.normal3(i.attitude));
  s.p += random.normal3(i.position);
  s.v += random.normal3(i.velocity);
  return s;
}

// What an estimator's attitude and velocity are off by, and lastingly so.
class SlowError {
 public:
  SlowError(const Instruments& i, Random random)
      : i_(i),
        random_(random),
        turn_(random_.normal3(i.attitude_drift)),
        v_(random_.normal3(i.velocity_bias)) {}

  Shown added_to(Shown s, double seconds_since_last) {
    const double left = std::exp(-seconds_since_last / i_.drift_time);
    turn_ = left * turn_ + random_.normal3(i_.attitude_drift * std::sqrt(1 - left * left));
    s.q = s.q * small_turn(turn_);
    s.v += v_;
    return s;
  }

 private:
  const Instruments& i_;
  Random random_;
  Vector3d turn_, v_;
};

// Rates and specific force behind a filter, with the noise that goes through it.
class FilteredImu {
 public:
  FilteredImu(const Instruments& i, const Vector3d& gyro_bias, Random random)
      : i_(i), bias_(gyro_bias), random_(random), gyro_(i.filter), acc_(i.filter) {}

  bool there() const { return i_.filter > 0; }
  // White noise of the same density as that of samples once a row.
  void step(const Shown& exact, double h) {
    const double more = std::sqrt(1 / (h * i_.rate));
    gyro_.step(exact.gyro + random_.normal3(i_.gyro * more), h);
    acc_.step(exact.acc + random_.normal3(i_.acc * more), h);
  }
  Shown in_place_of(Shown s) const {
    s.gyro = gyro_.value() + bias_, s.acc = acc_.value();
    return s;
  }

 private:
  const Instruments& i_;
  Vector3d bias_;
  Random random_;
  LowPass gyro_, acc_;
};

// Whole microseconds; what rounding took away is given back later, or small corrections would never be flown.
Four quantised(const Vehicle& v, const Four& delta, Four* carried) {
  const double span = v.pulse_max - v.pulse_min;
  const Four wanted = delta + *carried, rounded = (wanted * span).array().round() / span;
  *carried = wanted - rounded;
  return rounded.cwiseMax(0.0).cwiseMin(1.0);
}

void judge(const Vehicle& v, const Instant& now, const Reference& reference, Flight& flight) {
  const double tilt = std::acos(std::clamp((now.motion.q * Vector3d::UnitZ()).z(), -1.0, 1.0));
  flight.farthest = std::max(flight.farthest, (now.motion.p - reference.p).norm());
  flight.fastest = std::max(flight.fastest, now.motion.v.norm());
  flight.steepest = std::max(flight.steepest, tilt);
  flight.lowest = std::min(flight.lowest, -now.motion.p.z());
  const bool sound = now.motion.p.allFinite() && now.motion.w.norm() < 25 && tilt < 1.2 &&
                     now.motion.p.z() < -0.4 * v.radius && flight.farthest < 12;
  flight.flown = flight.flown && sound;
}

}  // namespace

Flight fly(const Vehicle& v, const Effects& e, const Instruments& instruments, const FlightSettings& settings,
           std::uint64_t seed, int index, double reference_voltage) {
  World world(v, e, settings, seed, index);
  const FlightPlan plan(v, settings.plan, Random(seed, World::stream(index, 3)));
  Random random(seed, World::stream(index, 4));
  Controller controller(v, settings.delay_margin);
  const Vector3d gyro_bias = random.normal3(instruments.gyro_bias);
  SlowError slow(instruments, Random(seed, World::stream(index, 5)));
  FilteredImu imu(instruments, gyro_bias, Random(seed, World::stream(index, 6)));

  Flight flight;
  flight.manoeuvres = plan.manoeuvres();
  flight.lowest = 1e3;
  State x = world.start(plan.at(0), settings.charge);
  flight.reference_voltage = reference_voltage > 0 ? reference_voltage : world.voltage(x);
  // A warm-up that is not logged lets vehicle and autopilot settle before the first row.
  constexpr double kWarmUp = 4;
  const double period = 1 / instruments.rate, end = settings.plan.duration;
  Past past;
  past.push(-kWarmUp, motion_of(x));
  Commands effective;
  Four carried = Four::Zero(), target = x.segment<4>(13), played = x.segment<4>(13) / v.km;
  double t = -kWarmUp;
  for (long k = -std::lround(kWarmUp * instruments.rate); t < end && flight.flown; ++k) {
    const double next =
        (static_cast<double>(k + 1) + random.uniform(-0.5, 0.5) * instruments.jitter) * period;
    const Motion motion = motion_of(x), late = past.at(t - e.sensor_delay);
    const Acceleration acceleration = world.slope(t, x, target).acceleration;
    const Four Omega = x.segment<4>(13);
    const Spin spin{Omega, x.segment<4>(17)};
    const Shown shown = with_noise(show(e, motion, late, acceleration), instruments, gyro_bias, random);
    const Motion believed{shown.p, motion.v, late.q, shown.gyro};
    const Reference reference = plan.at(std::max(t, 0.0));
    const Four wanted = controller.command(reference, believed, spin.Omega, spin.dOmega, next - t);
    const Four delta = quantised(v, wanted, &carried);
    const double volts = world.voltage(x);
    if (t >= 0) {
      flight.truth.push_back({t, motion, late, acceleration, spin, world.air(t), volts});
      const Four noise(random.normal(), random.normal(), random.normal(), random.normal());
      flight.rows.push_back({t, delta, Omega + instruments.speed_share * v.hover_speed() * noise,
                             slow.added_to(imu.there() ? imu.in_place_of(shown) : shown, period),
                             volts * (1 + instruments.voltage_share * random.normal())});
      flight.commands.push(t, delta);
      judge(v, flight.truth.back(), reference, flight);
    }
    played = e.backlash > 0 ? follow_with_play(played, delta, e.backlash) : delta;
    effective.push(t, played);
    const int steps = static_cast<int>(std::ceil((next - t) / kStep - 1e-9));
    const double h = (next - t) / steps;
    const double gain = speed_per_command(v, e, volts / flight.reference_voltage);
    for (int j = 0; j < steps; ++j) {
      const double now = t + j * h, from = now - e.command_delay;
      target = gain * effective.mean(from, from + h);
      x = world.step(now, x, target, h);
      past.push(now + h, motion_of(x));
      if (imu.there())
        imu.step(show(e, motion_of(x), past.at(now + h - e.sensor_delay),
                      world.slope(now + h, x, target).acceleration),
                 h);
    }
    t = next;
  }
  return flight;
}

}  // namespace withheld
