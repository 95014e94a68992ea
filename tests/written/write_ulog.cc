// The flight as PX4's logger stores it: topics at the logger's intervals, time since boot.
#include <cmath>
#include <limits>

#include "case.h"
#include "px4_facts.h"

namespace written {
namespace {

constexpr double kBoot = 37.2;  // s between boot and the start of the log
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::uint64_t micros(double t) { return static_cast<std::uint64_t>(std::llround((kBoot + t) * 1e6)); }

Bytes stamped(double published, double sampled) {
  return Bytes().put(micros(published)).put(micros(sampled));
}

Bytes& put(Bytes& to, const Vector3d& x) { return to.each<float>(x.x(), x.y(), x.z()); }

// Trapezoidal integral of VehicleIMU, divided by its length: the mean over the last 5 ms.
Vector3d mean_over(const Flight& flight, size_t k, size_t steps, Vector3d Sample::*field) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = k - steps; i < k; ++i)
    sum += 0.5 * (flight.samples[i].*field + flight.samples[i + 1].*field);
  return sum / static_cast<double>(steps);
}

class Writer {
 public:
  Writer(const Flight& flight, const Logging& logging) : flight_(flight), logging_(logging) {}

  void write(const std::string& path) {
    put_px4_facts(log_, flight_, logging_);
    const size_t fast = logging_.fast ? 10 : 0;  // full rate: every run of the rate controller, 400 Hz
    for (size_t k = 0; k < flight_.samples.size(); ++k) {
      const auto every = [&](size_t steps) { return k % steps == 0; };
      if (k > 0 && every(20)) sensor_combined(k);
      if (every(fast ? fast : 80)) angular_velocity(k), torque(k);
      if (every(80)) thrust(k), rates_setpoint(k);
      if (every(fast ? fast : 200)) acceleration(k);
      if (every(200)) attitude(k);
      if (every(400)) local_position(k);
      if (every(fast ? fast : 400)) motors(k);
      if (every(800)) battery(k);
      if (logging_.rotor_speeds && every(10)) escs(k);
      if (every(4000) || changes(k)) states(k);
    }
    log_.text(micros(0.01), "[logger] logging started");
    log_.text(micros(flight_.take_off), "[commander] Takeoff detected");
    log_.text(micros(flight_.landing + kLanded), "[commander] Landing detected");
    log_.write(path);
  }

 private:
  struct Ground {
    bool contact, maybe_landed, landed;
    bool operator==(const Ground&) const = default;
  };

  static double time(size_t k) { return static_cast<double>(k) * kStep; }
  Ground ground(double t) const {
    const double since = t - flight_.landing;
    const bool before = t < flight_.take_off + 0.1;
    return {before || since > kContact, before || since > kMaybeLanded, before || since > kLanded};
  }
  bool changes(size_t k) const {
    return k > 0 && (ground(time(k)) != ground(time(k - 1)) || at(k).armed != at(k - 1).armed);
  }
  const Sample& at(size_t k) const { return flight_.samples[k]; }
  void store(const char* topic, double published, const Bytes& record) {
    log_.data(topic, micros(published), record);
  }

  void sensor_combined(size_t k) {
    Bytes b = Bytes().put(micros(time(k)));
    put(b, mean_over(flight_, k, 20, &Sample::gyro)).put(std::uint32_t{5000}).put(std::int32_t{0});
    put(b, mean_over(flight_, k, 20, &Sample::accel)).put(std::uint32_t{5000}).zeros(4);
    store("sensor_combined", time(k) + 4e-4, b);
  }
  void angular_velocity(size_t k) {
    const double t = time(k);
    Bytes b = stamped(t + 1.5e-4, t);
    put(put(b, at(k).gyro_filtered), Vector3d::Zero());
    store("vehicle_angular_velocity", t + 1.5e-4, b);
  }
  void acceleration(size_t k) {
    const double t = time(k);
    Bytes b = stamped(t + 1.5e-4, t);
    store("vehicle_acceleration", t + 1.5e-4, put(b, at(k).accel_filtered));
  }
  void torque(size_t k) {
    const double t = time(k);
    Bytes b = stamped(t + 2e-5, t);
    store("vehicle_torque_setpoint", t + 2e-5, put(b, at(k).set.inputs.head<3>()));
  }
  void thrust(size_t k) {
    const double t = time(k);
    Bytes b = stamped(t + 2e-5, t);
    store("vehicle_thrust_setpoint", t + 2e-5, put(b, Vector3d(0, 0, -at(k).set.inputs[3])));
  }
  void rates_setpoint(size_t k) {
    const double t = time(k);
    Bytes b = Bytes().put(micros(t + 2e-4));
    put(b, at(k).set.rate).each<float>(0, 0, -at(k).set.inputs[3]).zeros(1);
    store("vehicle_rates_setpoint", t + 2e-4, b);
  }
  void motors(size_t k) {
    const double t = time(k);
    Bytes b = stamped(t + 2e-5, t);
    for (const double c : at(k).motors.stored) b.put(static_cast<float>(c));
    for (int n = 4; n < 12; ++n) b.put(kNaN);
    store("actuator_motors", t + 2e-5, b.zeros(2));
  }
  void attitude(size_t k) {
    const double t = time(k);
    const Eigen::Quaterniond& q = at(k).q_WB;
    store("vehicle_attitude", t + 5e-4,
          stamped(t + 5e-4, t).each<float>(q.w(), q.x(), q.y(), q.z(), 1, 0, 0, 0).zeros(1));
  }
  void local_position(size_t k) {
    const double t = time(k);
    const Sample& s = at(k);
    Bytes b = stamped(t + 6e-4, t);
    b.put(micros(0)).put(47.397742).put(8.545594);
    put(b, s.p_W).zeros(12);
    put(b, s.v_W).put(static_cast<float>(s.v_W.z())).zeros(12);
    put(b, s.q_WB * s.accel_filtered + Vector3d(0, 0, kGravity));
    const Eigen::Matrix3d R = s.q_WB.toRotationMatrix();
    b.each<float>(std::atan2(R(1, 0), R(0, 0)), 1e-3, 0, 0, 1e-4, 488, -s.p_W.z());
    b.each<float>(0.3, 0.3, 0.1, 0.1).each<float>(INFINITY, INFINITY, 0, INFINITY);
    b.each<std::uint8_t>(1, 1, 1, 1).zeros(5).each<std::uint8_t>(1, 1, 1, 0).zeros(2);
    store("vehicle_local_position", t + 6e-4, b);
  }
  void battery(size_t k) {
    const double t = time(k), volts = flight_.voltage(t);
    Bytes b = Bytes().put(micros(t + 1e-4));
    b.each<float>(volts, volts, 12, 12, 12, 100, 0.9, 1, NAN, NAN);
    for (int cell = 0; cell < 14; ++cell) b.put(cell < 4 ? static_cast<float>(volts / 4) : 0.0f);
    b.zeros(8 + 24 + 22).each<std::uint8_t>(1, 4, 0, 0, 1, 0, 1, 0, 0);
    store("battery_status", t + 1e-4, b);
  }
  // Telemetry of one ESC every 2.5 ms, in turn; the message goes out after each round of four.
  void escs(size_t k) {
    const size_t n = (k / 10) % 4;
    const double t = time(k);
    constexpr double pole_pairs = 7;
    const double erpm_100 = std::round(at(k).truth.Omega[n] * 30 / std::numbers::pi * pole_pairs / 100);
    esc_rpm_[n] = static_cast<std::int32_t>(erpm_100 * 100 / pole_pairs);
    esc_time_[n] = micros(t);
    if (n != 3) return;
    Bytes b = Bytes().put(micros(t + 1e-4)).put(static_cast<std::uint16_t>(k / 40));
    b.each<std::uint8_t>(4, 5, 0x0f, at(k).armed ? 0x0f : 0).zeros(2);
    for (size_t i = 0; i < 8; ++i) {
      if (i >= 4) {
        b.zeros(40);
        continue;
      }
      b.put(esc_time_[i]).put(std::uint32_t{0}).put(esc_rpm_[i]).each<float>(flight_.voltage(t), 3.0, 40.0);
      b.zeros(2).each<std::uint8_t>(0, 0, 0, 101 + i, 0).zeros(5);
    }
    store("esc_status", t + 1e-4, b);
  }
  void states(size_t k) {
    const double t = time(k);
    const bool armed = at(k).armed;
    const auto [contact, maybe, landed] = ground(t);
    store("vehicle_land_detected", t + 1e-4,
          Bytes()
              .put(micros(t + 1e-4))
              .each<std::uint8_t>(0, contact, maybe, landed, 0, 0, contact, 0, 0, 0, 1, landed));
    Bytes status = Bytes()
                       .put(micros(t + 2e-4))
                       .put(armed ? micros(kArm) : 0)
                       .put(landed ? 0 : micros(flight_.take_off));
    status.put(micros(0)).zeros(10).each<std::uint8_t>(armed ? 2 : 1, 1, 0, 2, 2, 0, 0, 1).zeros(11);
    status.each<std::uint8_t>(2, 1, 1).zeros(12);
    store("vehicle_status", t + 2e-4, status);
    store("vehicle_control_mode", t + 3e-4,
          Bytes().put(micros(t + 3e-4)).each<std::uint8_t>(armed, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 1, 1, 0, 2));
    store("actuator_armed", t + 4e-4,
          Bytes().put(micros(t + 4e-4)).each<std::uint8_t>(armed, 0, 1, 0, 0, 0, 0));
  }

  const Flight& flight_;
  Logging logging_;
  UlogFile log_;
  std::int32_t esc_rpm_[4] = {};
  std::uint64_t esc_time_[4] = {};
};

}  // namespace

void write_ulog(const std::string& path, const Flight& flight, const Logging& logging) {
  Writer(flight, logging).write(path);
}

}  // namespace written
