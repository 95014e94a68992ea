// Steps of the plant with the ground under it, and what is read after each.
#include "ident/fly/served_vehicle.h"

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"

namespace ident {
namespace {

constexpr double kLongestStep = 5e-4;  // s, as of simulated flights
constexpr double kForgetAfter = 30.0;  // s of commands that are kept before the old ones go

}  // namespace

ServedVehicle::ServedVehicle(const Vehicle& vehicle, double legs)
    : plant_(vehicle),
      ground_(plant_, legs),
      least_delta_(std::clamp(-plant_.constant(param::Omega_0) / plant_.constant(param::km), 0.0, 1.0)) {
  restart();
}

void ServedVehicle::restart() {
  const std::size_t rotors = vehicle().rotors.size();
  const double speed = plant_.constant(param::Omega_0) + plant_.constant(param::km) * least_delta_;
  const std::vector<double> Omega(rotors, speed), delta(rotors, least_delta_);
  const Vec3<double> rest = Vec3<double>::Zero(), stands(0.0, 0.0, ground_.standing_z());
  plant_.start(0.0, {Vec4<double>(1, 0, 0, 0), rest, rest, stands}, Omega, delta);
  if (vehicle().battery_voltage) plant_.voltage(0.0, 1.0);
  command_times_ = {0.0};
  commands_.assign(rotors, {least_delta_});
  readings_.start_W = stands;
  turning_.clear();
  touch(), look(), read();
}

std::vector<double> ServedVehicle::felt(std::span<const double> delta) const {
  std::vector<double> out;
  for (const double d : delta)
    out.push_back(std::isfinite(d) ? std::clamp(d, least_delta_, 1.0) : least_delta_);
  return out;
}

void ServedVehicle::step(std::span<const double> delta, double seconds) {
  const double start = plant_.t();
  const std::vector<double> given = felt(delta);
  const bool new_command =
      !std::ranges::equal(given, commands_, {}, {}, [](const auto& c) { return c.back(); });
  if (new_command) {
    plant_.command(start, given);
    command_times_.push_back(start);
    for (std::size_t n = 0; n < given.size(); ++n) commands_[n].push_back(given[n]);
  }
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / kLongestStep * (1.0 - 1e-9))));
  for (int i = 1; i <= steps; ++i) {
    plant_.advance(start + seconds * i / steps, seconds);
    touch(), look();
  }
  read();
  forget();
  if (!state().body.x_W.allFinite() || !state().body.w_B.allFinite())
    throw DataError("the motion of the served vehicle left the numbers: check its inertia and its legs");
}

void ServedVehicle::touch() {
  const Wrench<double> ground = ground_.at(state().body);
  plant_.disturb(ground.F_B, ground.M_B);
}

void ServedVehicle::look() {
  turning_.push_back({plant_.t(), plant_.imu().gyro, state().body.q_WB});
  const double wanted = plant_.t() - plant_.sensor_delay();
  while (turning_.size() > 1 && turning_[1].t <= wanted) turning_.pop_front();
}

// Rates and attitude of `sensor_delay` ago, between the two looks around that time.
ServedVehicle::Turning ServedVehicle::delayed() const {
  const double wanted = plant_.t() - plant_.sensor_delay();
  const Turning& before = turning_.front();
  if (turning_.size() < 2 || wanted <= before.t) return before;
  const Turning& after = turning_[1];
  const double share = (wanted - before.t) / (after.t - before.t);
  const Vec4<double> q = before.q_WB + share * (after.q_WB - before.q_WB);
  return {wanted, before.gyro_B + share * (after.gyro_B - before.gyro_B), q.normalized()};
}

void ServedVehicle::read() {
  const Turning shown = delayed();
  readings_.t = plant_.t();
  readings_.gyro_B = shown.gyro_B, readings_.q_WB = shown.q_WB;
  readings_.f_B = plant_.imu().f_B;
  readings_.v_W = state().body.v_W, readings_.x_W = state().body.x_W;
  readings_.Omega.resize(vehicle().rotors.size());
  for (std::size_t n = 0; n < readings_.Omega.size(); ++n) readings_.Omega[n] = state().motors[n].Omega;
  readings_.voltage = vehicle().battery_voltage;
}

// A served vehicle may fly for days: commands that no motor will feel any more go.
void ServedVehicle::forget() {
  if (plant_.t() - command_times_.front() < kForgetAfter + plant_.command_delay()) return;
  const double oldest = plant_.t() - plant_.command_delay() - kForgetAfter / 2;
  const auto holds = std::ranges::upper_bound(command_times_, oldest);
  const auto gone = std::max<std::ptrdiff_t>(0, holds - command_times_.begin() - 1);
  if (gone == 0) return;
  command_times_.erase(command_times_.begin(), command_times_.begin() + gone);
  for (std::vector<double>& column : commands_) column.erase(column.begin(), column.begin() + gone);
  plant_.recall(command_times_, commands_);
}

}  // namespace ident
