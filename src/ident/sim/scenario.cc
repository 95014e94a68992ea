// Manoeuvres scaled to what the vehicle can do.
#include "ident/sim/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/core/random.h"

namespace ident {
namespace {

using std::numbers::pi;

/// 0 to 1 with vanishing first and second derivative at both ends.
double smooth(double s) {
  const double x = std::clamp(s, 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}
constexpr double kSmoothPeak = 5.78;  // greatest second derivative of `smooth`

/// 1 inside a leg, smoothly 0 at its ends.
double envelope(double s, double duration, double ramp) {
  return smooth(s / ramp) * smooth((duration - s) / ramp);
}

const std::vector<ScenarioInfo>& list() {
  static const std::vector<ScenarioInfo> all = {
      {"mixed", "all of the others in turn, with a faint multisine throughout: rich enough for everything"},
      {"hover", "hover with a multisine on every rotor, each with frequencies of its own"},
      {"steps", "position steps to and fro along north and east"},
      {"eight", "figure eights, the fast part"},
      {"vertical", "steps up, and down to near the ground"},
      {"yaw", "yaw doublets, then a slow full turn"},
      {"phang", "1 Hz sinusoid on opposing rotors, one pair after the other [Phang, Figs. 7, 8]"}};
  return all;
}

}  // namespace

std::span<const ScenarioInfo> scenarios() { return list(); }

Scenario::Scenario(const std::string& name, double duration, const Plant& plant, const Trim& trim,
                   const Agility& agility, double rate, std::uint64_t seed)
    : agility_(agility), ground_z_(plant.vehicle().ground_z) {
  double reach = 0.0;
  for (const Rotor& rotor : plant.vehicle().rotors) reach = std::max(reach, rotor.r_B.norm());
  low_ = std::clamp(1.5 * reach, 0.3, 1.2);
  plan(name, duration);
  plan_tones(plant, trim, rate, seed);
}

void Scenario::plan(const std::string& name, double duration) {
  using enum Kind;
  struct Part {
    Kind kind;
    double share;
  };
  std::vector<Part> parts;
  if (name == "hover") parts = {{multisine, 1.0}};
  if (name == "steps") parts = {{steps, 1.0}};
  if (name == "eight") parts = {{figure_eight, 1.0}};
  if (name == "vertical") parts = {{vertical, 1.0}};
  if (name == "yaw") parts = {{yaw, 0.6}, {turn, 0.4}};
  if (name == "phang") parts = {{opposing, 1.0}};
  if (name == "mixed") {
    parts = {{multisine, 0.2}, {steps, 0.14}, {figure_eight, 0.24}, {vertical, 0.16},
             {yaw, 0.09},      {turn, 0.09},  {opposing, 0.08}};
    background_ = 0.4;
  }
  if (parts.empty()) {
    std::vector<std::string> names;
    for (const ScenarioInfo& info : list()) names.push_back(info.name);
    throw UsageError(fmt::format("unknown scenario '{}'{}", name, did_you_mean(name, names)));
  }
  double start = 0.0;
  for (const Part& part : parts) {
    legs_.push_back({part.kind, start, part.share * duration});
    start += part.share * duration;
  }
}

// Amplitudes that turn the vehicle by a few degrees against its controller, within a quarter of the command.
void Scenario::plan_tones(const Plant& plant, const Trim& trim, double rate, std::uint64_t seed) {
  const std::size_t rotors = trim.Omega.size();
  const double w = plant.constant(param::omega_m), zeta = plant.constant(param::zeta_m);
  const auto amplitude = [&](std::size_t n, double hertz, double angle) {
    const double omega = 2 * pi * hertz, p = agility_.attitude_bandwidth;
    const double x = omega / w;
    const double response = 1.0 / std::hypot(1.0 - x * x, 2 * zeta * x);
    const double turn = trim.effect.col(static_cast<Eigen::Index>(n)).head<2>().norm() * 2 * trim.Omega[n] *
                        plant.constant(param::km) * response;
    const double room = std::min(trim.delta[n] - 0.03, 1.0 - trim.delta[n]);
    return std::min(angle * (omega * omega + p * p) / std::max(turn, 1e-9), room);
  };
  Random random(seed ^ 0x5ce2a710ULL);
  const int each = 6;
  const double low = 0.3, high = std::clamp(w / pi, 2.0, std::min(12.0, rate / 8));
  const int count = each * static_cast<int>(rotors);
  for (int k = 0; k < count; ++k) {
    const auto n = static_cast<std::size_t>(k) % rotors;
    const double hertz = low * std::pow(high / low, k / (count - 1.0));
    const double room = std::min(trim.delta[n] - 0.03, 1.0 - trim.delta[n]);
    tones_.push_back({n, std::min(amplitude(n, hertz, 0.025), 0.3 * room / std::sqrt(1.0 * each)), hertz,
                      random.uniform(0.0, 2 * pi)});
  }
  for (std::size_t n = 0; n < rotors; ++n) {
    const auto& rotor = plant.vehicle().rotors;
    std::size_t opposite = n;
    for (std::size_t k = 0; k < rotors; ++k)
      if (rotor[k].r_B.dot(rotor[n].r_B) < rotor[opposite].r_B.dot(rotor[n].r_B)) opposite = k;
    if (opposite <= n) continue;
    const double size = std::min(0.5 * amplitude(n, 1.0, 0.15), 0.5 * amplitude(n, 1.0, 1e9));
    opposing_.push_back({{n, size, 1.0, 0.0}, {opposite, size, 1.0, pi}});
  }
}

const Scenario::Leg* Scenario::leg_at(double t) const {
  for (const Leg& leg : legs_)
    if (t >= leg.start && t < leg.start + leg.duration) return &leg;
  return nullptr;
}

// To and fro: pairs of moves, each as quick as the vehicle may, with a rest after each.
Scenario::Pose Scenario::shuttle(const Leg& leg, double s) const {
  const bool turning = leg.kind == Kind::yaw, vertical = leg.kind == Kind::vertical;
  const double pole = turning    ? agility_.yaw_bandwidth
                      : vertical ? agility_.lift_bandwidth
                                 : agility_.position_bandwidth;
  const double needed = std::max(3.0 / pole, 1.5);  // s for a move; in haste 0.6 of it will do
  const int fours = static_cast<int>(leg.duration / (4 * needed));
  const int moves = fours > 0 ? 4 * fours : leg.duration > 4 * 0.6 * needed ? 4 : 2;
  const double each = leg.duration / moves, moving = 0.65 * each;
  // Where a leg is too short for moves that the vehicle can follow, they shrink with the squared time.
  const double hurry = std::max(0.6 * needed / each, 1.0);
  const double most = turning    ? agility_.yaw_acceleration
                      : vertical ? agility_.lift_acceleration
                                 : agility_.tilt_acceleration;
  const double reach = most * moving * moving / kSmoothPeak / (hurry * hurry);
  const int i = std::min(static_cast<int>(s / each), moves - 1);
  const double part = smooth((s - i * each) / moving);
  const double out = i % 2 == 0 ? part : 1.0 - part;  // even moves go out, odd ones come back
  const bool second = i % 4 >= 2;                     // the second pair goes the other way
  Pose pose;
  if (turning) {
    pose.psi = (second ? -1.0 : 1.0) * std::min(reach, 0.8) * out;
  } else if (vertical) {
    pose.offset_W[2] = second ? std::min(reach, kHeight - low_) * out : -std::min(reach, 2.0) * out;
  } else {
    pose.offset_W[second ? 1 : 0] = (i % 8 >= 4 ? -1.0 : 1.0) * std::min(reach, 2.5) * out;
  }
  return pose;
}

// North A sin(w s), east A/2 sin(2 w s); accelerations up to 2 A w^2, speeds up to 1.4 A w.
Scenario::Pose Scenario::eight(const Leg& leg, double s) const {
  const double ramp = 0.25 * leg.duration;
  double w = std::min(1.2, 1.2 * agility_.position_bandwidth);
  w = 2 * pi * std::max(1.0, std::round(w * leg.duration / (2 * pi))) / leg.duration;
  const double A = std::min(0.45 * agility_.tilt_acceleration / (w * w), 3.5 / (1.4 * w));
  const double size = A * envelope(s, leg.duration, ramp);
  return {Vec3<double>(size * std::sin(w * s), size / 2 * std::sin(2 * w * s), 0.0), 0.0};
}

Scenario::Pose Scenario::pose(double t) const {
  const Leg* leg = leg_at(t);
  if (!leg) return {};
  const double s = t - leg->start;
  switch (leg->kind) {
    case Kind::steps:
    case Kind::vertical:
    case Kind::yaw:
      return shuttle(*leg, s);
    case Kind::figure_eight:
      return eight(*leg, s);
    case Kind::turn:
      return {Vec3<double>::Zero(), 2 * pi * smooth(s / leg->duration)};
    case Kind::multisine:
    case Kind::opposing:
      break;
  }
  return {};
}

Setpoint Scenario::setpoint(double t) const {
  constexpr double h = 5e-3;
  const auto place = [&](double at) {
    return Vec3<double>(pose(at).offset_W + Vec3<double>(0, 0, ground_z_ - kHeight));
  };
  const auto acceleration = [&](double at) {
    return Vec3<double>((place(at + h) - 2.0 * place(at) + place(at - h)) / (h * h));
  };
  Setpoint to;
  to.x_W = place(t), to.v_W = (place(t + h) - place(t - h)) / (2 * h);
  to.a_W = acceleration(t), to.a_soon_W = acceleration(t + kAhead);
  to.psi = pose(t).psi, to.psi_soon = pose(t + kAhead).psi;
  if (to.psi_soon - to.psi < -pi) to.psi_soon += 2 * pi;  // the end of a full turn
  return to;
}

void Scenario::excite(double t, std::span<double> delta) const {
  const Leg* leg = leg_at(t);
  if (!leg) return;
  const double s = t - leg->start, ramp = std::min(1.0, leg->duration / 4);
  const double inside = envelope(s, leg->duration, ramp);
  const double share =
      leg->kind == Kind::multisine ? background_ + (1.0 - background_) * inside : background_;
  if (share > 0)
    for (const Tone& tone : tones_)
      delta[tone.rotor] += share * tone.amplitude * std::sin(2 * pi * tone.frequency * t + tone.phase);
  if (leg->kind == Kind::opposing && !opposing_.empty()) {
    const auto pairs = static_cast<double>(opposing_.size());
    const double each = leg->duration / pairs;
    const auto pair = std::min(static_cast<std::size_t>(s / each), opposing_.size() - 1);
    const double within = s - static_cast<double>(pair) * each;
    for (const Tone& tone : opposing_[pair])
      delta[tone.rotor] += envelope(within, each, std::min(1.0, each / 4)) * tone.amplitude *
                           std::sin(2 * pi * tone.frequency * within + tone.phase);
  }
  for (double& d : delta) d = std::clamp(d, 0.0, 1.0);
}

}  // namespace ident
