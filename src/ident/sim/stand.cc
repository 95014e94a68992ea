// The rotor on a bench with all its effects: the model declares it, the effects complete it.
#include "ident/sim/stand.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "ident/core/error.h"
#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"

namespace ident {
namespace {

/// What the body's equations ask for, where a bench test does not need it.
Vehicle completed(Vehicle vehicle) {
  for (const char* name : {"m", "Jxx", "Jyy", "Jzz", "kT"})
    if (!vehicle.has(name)) vehicle.parameters[name] = {1.0, {}};
  if (vehicle.rotors.empty()) vehicle.rotors.push_back({});
  return vehicle;
}

}  // namespace

struct Stand::Model {
  Vehicle given, vehicle;
  std::size_t rotor;
  std::vector<double> p;
  EffectSet<double> effects;
  FlightInputs inputs;
  std::optional<Flight<double, EffectSet<double>>> flight;
  std::array<MotorState<double>, kMaxRotors> motors{};
  std::deque<double> arrivals;  // times at which a new command reaches the motor
  double t = 0.0, delay = 0.0;

  Model(const Vehicle& stated, std::size_t index)
      : given(stated),
        vehicle(completed(stated)),
        rotor(index),
        p(parameter_vector(vehicle)),
        effects(p, active_effects(p)) {
    if (rotor >= vehicle.rotors.size() || vehicle.rotors.size() > static_cast<std::size_t>(kMaxRotors))
      throw UsageError("rotor: the vehicle has " + std::to_string(vehicle.rotors.size()) +
                       " rotors, at most 8 are modelled");
    inputs.delta.resize(vehicle.rotors.size());
    flight.emplace(vehicle, p, effects, inputs);
    TimeSeam<double> delays{p[param::dead_time], 0.0};
    effects.apply(delays);
    delay = delays.command_delay;
  }

  /// The motor's solution is exact while its command is constant; where spin-down differs from spin-up it is
  /// chosen anew for each step.
  void advance(double to) {
    constexpr double kLongestStep = 1e-3;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - t) / kLongestStep)));
    const double from = t, h = (to - from) / steps;
    if (!(to > from)) return;
    for (int i = 0; i < steps; ++i) flight->advance(motors, from + i * h, h);
    t = to;
  }
};

Stand::Stand(const Vehicle& vehicle, std::size_t rotor) : model_(std::make_unique<Model>(vehicle, rotor)) {}
Stand::~Stand() = default;

double Stand::needed(const char* name) const {
  const Vehicle& vehicle = model_->given;
  if (vehicle.has(name) && vehicle.value(name) > 0.0) return vehicle.value(name);
  throw UsageError((vehicle.file.empty() ? std::string("vehicle") : vehicle.file) + ": " + name +
                   ": a positive value is needed to simulate this test");
}

Stand::Load Stand::load(double Omega) const {
  constexpr double kFarUp = 1e3;  // m, out of ground effect
  const Vec3<double> none = Vec3<double>::Zero();
  RotorSeam<double> seam{.index = static_cast<int>(model_->rotor),
                         .per_Omega_hover = &model_->flight->body().per_Omega_hover(),
                         .Omega = Omega,
                         .v_air_B = none,
                         .height = kFarUp,
                         .a_B = model_->vehicle.rotors[model_->rotor].a_B,
                         .T = model_->p[param::kT] * Omega * Omega,
                         .Q = model_->p[param::kQ] * Omega * Omega,
                         .F_B = none,
                         .M_B = none};
  model_->effects.apply(seam);
  return {seam.T, seam.Q};
}

void Stand::start(double t, double delta) {
  model_->t = model_->inputs.t0 = t;
  for (HeldCommand& command : model_->inputs.delta) command = HeldCommand({t}, {delta});
  model_->arrivals.clear();
  model_->motors.fill({steady_speed(delta), 0.0});
}

void Stand::command(double t, double delta) {
  model_->inputs.delta[model_->rotor].append(t, delta);
  model_->arrivals.push_back(t + model_->delay);
}

void Stand::advance(double t) {
  for (; !model_->arrivals.empty() && model_->arrivals.front() < t; model_->arrivals.pop_front())
    model_->advance(model_->arrivals.front());
  model_->advance(t);
}

double Stand::Omega() const { return model_->motors[model_->rotor].Omega; }

double Stand::steady_speed(double delta) const {
  DriveSeam<double> drive{0.0, 1.0, false, 1.0, 1.0};
  model_->effects.apply(drive);
  return (model_->p[param::Omega_0] + model_->p[param::km] * delta) * drive.gain;
}

}  // namespace ident
