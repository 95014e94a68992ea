// Sums up what each cause changes over windows of the flight.
#include "ledger.h"

#include <algorithm>
#include <cmath>

namespace field {
namespace {

const std::vector<std::string> kInstantCauses{
    "rotor_drag",    "parasitic_drag", "translational_lift", "axial_inflow", "blade_flapping",
    "ground_effect", "wind",           "rotor_mismatch",     "cg_offset",    "products_of_inertia",
    "gyroscopic",    "propwash"};
const std::vector<std::string> kSensorCauses{"imu_bias", "imu_lever_arm", "imu_misalignment"};

Signature difference(const Instant& x, const Acceleration& lacking, const PerRotor& dOmega) {
  Signature s;
  s.f_B = x.now.f_B - lacking.f_B;
  s.f_W = x.motion.q_WB * s.f_B;
  s.dw_B = x.now.dw_B - lacking.dw_B;
  s.dOmega = dOmega;
  return s;
}

Signature of_sensor(const Instant& x, const std::string& cause) {
  const Vector3d &w = x.motion.w_B, f = x.now.f_B;
  Signature s;
  s.dOmega = PerRotor::Zero(x.v.rotors());
  if (cause == "imu_bias") s.accel = x.e.imu_bias;
  if (cause == "imu_lever_arm") s.accel = x.now.dw_B.cross(x.e.imu_r_B) + w.cross(w.cross(x.e.imu_r_B));
  if (cause == "imu_misalignment") {
    s.accel = f.cross(x.e.imu_turn);
    s.gyro = w.cross(x.e.imu_turn);
  }
  if (cause == "sensor_delay") s.gyro = -x.gyro_delay * x.now.dw_B;
  return s;
}

// One window as a vector of errors over noise.
struct Window {
  Vector3d velocity = Vector3d::Zero(), rates = Vector3d::Zero(), accel = Vector3d::Zero();
  PerRotor speeds;
};

Window window_of(const std::vector<Signature>& series, size_t from, double hz, double mean_z) {
  const auto half_second = static_cast<size_t>(0.5 * hz), tenth = static_cast<size_t>(0.1 * hz);
  Window w;
  for (size_t k = from; k < from + half_second; ++k)
    w.velocity += (series[k].f_W - Vector3d(0, 0, mean_z)) / hz;
  for (size_t k = from; k < from + tenth; ++k) w.rates += series[k].dw_B / hz;
  w.rates += series[from + tenth].gyro - series[from].gyro;
  const Signature& end = series[from + half_second];
  w.accel = end.f_B - Vector3d(0, 0, mean_z) + end.accel;
  w.speeds = end.dOmega;
  return w;
}

struct Sum {
  double forces = 0, moments = 0, all = 0;
};

void accumulate(Sum& sum, const Window& w, const Instruments& in) {
  const double forces = w.velocity.squaredNorm() / std::pow(in.velocity_noise, 2);
  const double moments = w.rates.squaredNorm() / std::pow(in.gyro_sigma(), 2);
  double all = forces + moments + w.accel.squaredNorm() / std::pow(in.accel_sigma(), 2);
  if (in.rotor_speeds) all += w.speeds.square().sum();
  sum.forces += forces;
  sum.moments += moments;
  sum.all += all;
}

Window less(Window a, const Window& b) {
  a.velocity -= b.velocity;
  a.rates -= b.rates;
  a.accel -= b.accel;
  a.speeds -= b.speeds;
  return a;
}

double closed(double rest, double total) { return total > 0 ? 1 - rest / total : 0; }

bool is_constant(const std::string& cause) { return cause.starts_with("parameter:"); }

double mean_z(const std::vector<Signature>& series, const std::string& cause) {
  if (is_constant(cause)) return 0;
  double sum = 0;
  for (const Signature& s : series) sum += s.f_B.z();
  return sum / static_cast<double>(series.size());
}

}  // namespace

std::map<std::string, Share> Ledger::shares(const Instruments& in,
                                            const std::vector<std::string>& causes) const {
  std::map<std::string, Share> shares;
  std::map<std::string, std::vector<Window>> windows;
  const auto step = static_cast<size_t>(0.1 * hz_), span = static_cast<size_t>(0.5 * hz_) + 1;
  const double speed_unit = in.speed_noise;  // relative; scaled by the mean speed below
  size_t count = 0;
  for (const auto& cause : causes) {
    if (!series_.contains(cause)) continue;
    const auto& series = series_.at(cause);
    const double mean = mean_z(series, cause);
    for (size_t k = 0; k + span < series.size(); k += step) {
      windows[cause].push_back(window_of(series, k, hz_, mean));
      windows[cause].back().speeds /= speed_unit;
    }
    count = windows[cause].size();
  }
  Sum total;
  std::map<std::string, Sum> rest;
  for (size_t i = 0; i < count; ++i) {
    Window everything = windows.begin()->second[i];
    for (auto it = std::next(windows.begin()); it != windows.end(); ++it) {
      Window minus = it->second[i];
      minus = less(less(minus, minus), minus);
      everything = less(everything, minus);
    }
    accumulate(total, everything, in);
    for (const auto& [cause, list] : windows) accumulate(rest[cause], less(everything, list[i]), in);
  }
  for (const auto& [cause, list] : windows) {
    Share& s = shares[cause];
    s.all = closed(rest[cause].all, total.all);
    s.forces = closed(rest[cause].forces, total.forces);
    s.moments = closed(rest[cause].moments, total.moments);
    for (const Window& w : list) {
      s.velocity_rms += w.velocity.squaredNorm() / static_cast<double>(list.size());
      s.rate_rms += w.rates.squaredNorm() / static_cast<double>(list.size());
    }
    s.velocity_rms = std::sqrt(s.velocity_rms);
    s.rate_rms = std::sqrt(s.rate_rms);
  }
  return shares;
}

std::vector<Shadow> draw_up_shadows(const Vehicle& v, const Effects& e, const Stated& stated) {
  std::vector<Shadow> shadows;
  if (e.sag_exponent > 0) shadows.push_back({"battery_sag", {.sags = false}, v});
  if (v.lag_down > v.lag_up) shadows.push_back({"motor_asymmetry", {.asymmetric = false}, v});
  if (v.latency > 0) shadows.push_back({"motor_delay", {.late = false}, v});
  if (e.dead_zone > 0) shadows.push_back({"esc_dead_zone", {.dead_zone = false}, v});
  for (const char* name : {"km", "lag", "Omega_0"}) {
    if (stated.states(name)) {
      shadows.push_back(
          {std::string("parameter:") + name, {}, with_stated(v, name, stated.constants.at(name).value)});
    }
  }
  return shadows;
}

void record(Ledger& ledger, const Instant& x, const std::map<std::string, PerRotor>& shadow_speeds) {
  const PerRotor same = PerRotor::Zero(x.v.rotors());
  const auto again = [&](const Vehicle& v, const Effects& e, const RotorState& rotors, const AirSample& air) {
    return accelerate(v, e, x.motion, rotors, air);
  };
  const auto slosh = [&](Acceleration a) {  // the tank acts in both
    a.f_B += x.now.f_B - x.rigid.f_B;
    a.dw_B += x.now.dw_B - x.rigid.dw_B;
    return a;
  };
  for (const auto& cause : kInstantCauses) {
    ledger.add(cause, difference(x, slosh(again(x.v, without(x.e, cause), x.rotors, x.air)), same));
  }
  for (const auto& cause : kSensorCauses) ledger.add(cause, of_sensor(x, cause));
  ledger.add("sensor_delay", of_sensor(x, "sensor_delay"));
  ledger.add("slosh", difference(x, x.rigid, same));
  RotorState stiff = x.rotors;
  stiff.arm_force.setZero();
  ledger.add("flexible_arms", difference(x, slosh(again(x.v, x.e, stiff, x.air)), same));
  AirSample alone = x.air;
  alone.v_W.z() -= x.burst;
  ledger.add("downwash_bursts", difference(x, slosh(again(x.v, x.e, x.rotors, alone)), same));
  for (const auto& [cause, Omega] : shadow_speeds) {
    RotorState other = x.rotors;
    other.Omega = Omega;
    ledger.add(cause, difference(x, slosh(again(x.v, x.e, other, x.air)),
                                 (x.rotors.Omega - Omega) / x.v.hover_speed()));
  }
  for (const char* name : {"m", "kT", "kQ", "Jxx", "Jyy", "Jzz"}) {
    const Vehicle stated = with_stated(x.v, name, x.stated.constants.at(name).value);
    ledger.add(std::string("parameter:") + name,
               difference(x, slosh(again(stated, x.e, x.rotors, x.air)), same));
  }
}

}  // namespace field
