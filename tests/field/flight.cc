// The loop over time.
#include "flight.h"

#include <algorithm>
#include <cmath>

#include "outside.h"

namespace field {
namespace {

constexpr double kWarmUp = 4;  // s that are flown before the log starts
constexpr double kLedgerHz = 100;

class Simulation {
 public:
  Simulation(const Vehicle& v, const Effects& e, const Tuning& tuning, const Instruments& in,
             const FlightSettings& settings, const Stated* stated, Random& random)
      : v_(v),
        e_(e),
        in_(in),
        settings_(settings),
        stated_(stated),
        random_(random),
        dt_(1 / in.physics_hz),
        loop_every_(std::lround(in.physics_hz / tuning.loop_hz)),
        plan_(random, settings.limits, settings.duration, settings.style),
        gusts_(settings.air, settings.gust_share, 2 * v.l, Random(random.integer(0, 1 << 30), 1, "gusts"),
               dt_),
        sensors_(v, e, in, Random(random.integer(0, 1 << 30), 2, "sensors")),
        autopilot_(v, tuning, Vector3d::Zero()),
        battery_(v.battery, settings.charge),
        drive_(v, e, {}, dt_, PerRotor::Constant(v.rotors(), v.hover_speed())),
        arms_(e, v.rotors(), dt_),
        tank_(v, e, dt_),
        wash_(v, e, Random(random.integer(0, 1 << 30), 3, "wash"), dt_) {
    if (e.bursts) bursts_ = draw_bursts(random, settings.duration, v.hover_inflow());
    if (stated) {
      shadows_ = draw_up_shadows(v, e, *stated);
      shadow_drives_.reserve(shadows_.size());
      for (const Shadow& s : shadows_) {
        shadow_drives_.emplace_back(s.vehicle, e, s.traits, dt_, drive_.Omega());
      }
      flight_.ledger.emplace(kLedgerHz);
    }
    motion_.p_W = Vector3d(0, 0, -settings.limits.height);
    rotors_ = {drive_.Omega(), drive_.dOmega(), PerRotor::Zero(v.rotors()), PerRotor::Zero(v.rotors())};
    command_ = (drive_.Omega() - v.Omega_0) / v.km;
    flight_.manoeuvres = plan_.names();
    flight_.lowest = 1e3;
  }

  Flight run() {
    const long steps = std::lround((kWarmUp + settings_.duration) / dt_);
    for (long k = 0; k < steps; ++k) step(k);
    flight_.saturated = autopilot_.saturated_share();
    flight_.voltage_last = battery_.voltage();
    flight_.mean_thrust /= static_cast<double>(flight_.rows.size());
    flight_.rms_position_error =
        std::sqrt(flight_.rms_position_error / static_cast<double>(flight_.rows.size()));
    return std::move(flight_);
  }

 private:
  void step(long k) {
    const double t = static_cast<double>(k) * dt_ - kWarmUp;
    AirSample air = gusts_.next();
    const double spreads =
        std::clamp(-motion_.p_W.z() / 2, 0.0, 1.0);  // downwash turns aside above the ground
    const double burst = spreads * burst_speed(bursts_, t);
    air.v_W.z() += burst;
    rotors_.Omega = drive_.Omega();
    rotors_.dOmega = drive_.dOmega();
    rotors_.fluctuation = wash_.advance(motion_, e_.wind_W);
    if (e_.arm_hz > 0) rotors_.arm_force = arms_.advance(rotor_loads(v_, e_, motion_, rotors_, air));
    const Acceleration rigid = accelerate(v_, e_, motion_, rotors_, air);
    const Acceleration a = tank_.advance(rigid);
    sensors_.step({t, motion_, a, rotors_.Omega, command_, battery_.voltage()});
    if (k % loop_every_ == 0) control(t);
    if (t >= -0.5 * dt_) observe(k - std::lround(kWarmUp / dt_), t, {rigid, a, air, burst});
    motion_ = advance(v_, e_, motion_, a, dt_);
    if (!(motion_.p_W.norm() < 1e5)) throw std::runtime_error("the vehicle fell out of control");
    move_motors();
  }

  void control(double t) {
    const Reading reading{sensors_.raw_gyro(), motion_.p_W,
                          motion_.v_W + 0.01 * Vector3d(random_.normal(), random_.normal(), random_.normal()),
                          motion_.q_WB, battery_.voltage() * (1 + 0.003 * random_.normal())};
    command_ = autopilot_.update(reading, plan_.at(std::max(0.0, t)));
  }

  void move_motors() {
    const double power = (v_.kQ * rotors_.Omega.cube()).sum();
    battery_.advance(power, dt_);
    drive_.advance(command_, battery_.voltage());
    for (Drive& shadow : shadow_drives_) shadow.advance(command_, battery_.voltage());
  }

  struct Step {
    const Acceleration &rigid, &a;
    const AirSample& air;
    double burst;
  };

  void observe(long k, double t, const Step& now) {
    if (stated_ && k % std::lround(1 / (kLedgerHz * dt_)) == 0) {
      std::map<std::string, PerRotor> speeds;
      for (size_t i = 0; i < shadows_.size(); ++i) speeds[shadows_[i].cause] = shadow_drives_[i].Omega();
      record(*flight_.ledger,
             {v_, e_, *stated_, motion_, rotors_, now.air, now.a, now.rigid, now.burst, in_.gyro_delay()},
             speeds);
    }
    const long every = std::lround(in_.physics_hz / in_.log_hz);
    if (k % every != 0) return;
    flight_.rows.push_back(sensors_.row(t, k / every, command_));
    note(t, now.a);
  }

  void note(double t, const Acceleration& a) {
    Flight& f = flight_;
    const Vector3d up_W = motion_.q_WB * Vector3d(0, 0, -1);
    if (f.voltage_first == 0) f.voltage_first = battery_.voltage();
    f.greatest_rate = std::max(f.greatest_rate, motion_.w_B.norm());
    f.greatest_tilt = std::max(f.greatest_tilt, std::acos(std::clamp(-up_W.z(), -1.0, 1.0)));
    f.greatest_speed = std::max(f.greatest_speed, motion_.v_W.norm());
    f.lowest = std::min(f.lowest, -motion_.p_W.z());
    f.mean_thrust -= (motion_.q_WB * a.f_B).z() / kGravity;
    f.command_least = std::min(f.command_least, command_.minCoeff());
    f.command_most = std::max(f.command_most, command_.maxCoeff());
    f.rms_position_error += (motion_.p_W - plan_.at(std::max(0.0, t)).p_W).squaredNorm();
  }

  const Vehicle& v_;
  const Effects& e_;
  const Instruments& in_;
  const FlightSettings& settings_;
  const Stated* stated_;
  Random& random_;
  double dt_;
  long loop_every_;
  FlightPlan plan_;
  Gusts gusts_;
  Sensors sensors_;
  Autopilot autopilot_;
  BatteryState battery_;
  Drive drive_;
  BendingArms arms_;
  SloshingTank tank_;
  Propwash wash_;
  std::vector<Burst> bursts_;
  std::vector<Shadow> shadows_;
  std::vector<Drive> shadow_drives_;
  Motion motion_;
  RotorState rotors_;
  PerRotor command_;
  Flight flight_;
};

}  // namespace

Flight fly(const Vehicle& v, const Effects& e, const Tuning& tuning, const Instruments& instruments,
           const FlightSettings& settings, const Stated* stated, Random random) {
  return Simulation(v, e, tuning, instruments, settings, stated, random).run();
}

}  // namespace field
