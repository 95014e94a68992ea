// The flying vehicle with all its effects: the model declares it, the effects complete it.
#include "ident/sim/plant.h"

#include <cmath>
#include <optional>

#include "ident/core/error.h"
#include "ident/effects/catalogue.h"

namespace ident {
namespace {

/// The vehicle's effects, and a force and a moment from outside.
struct DisturbedEffects {
  EffectSet<double> own;
  Vec3<double> F_B = Vec3<double>::Zero(), M_B = Vec3<double>::Zero();

  template <class Seam>
  void apply(Seam& seam) const {
    own.apply(seam);
    if constexpr (std::is_same_v<Seam, BodySeam<double>>) {
      seam.F_B += F_B;
      seam.M_B += M_B;
    }
  }
  unsigned touches() const { return own.touches() | kTouchFlow; }
};

Vehicle checked(const Vehicle& vehicle) {
  const std::string where = vehicle.file.empty() ? std::string("vehicle") : vehicle.file;
  if (vehicle.rotors.empty()) throw UsageError(where + ": rotors: none is given, nothing flies");
  if (vehicle.rotors.size() > static_cast<std::size_t>(kMaxRotors))
    throw UsageError(where + ": rotors: at most 8 are modelled");
  for (const char* name : {"km", "omega_m"})
    if (!(vehicle.value(name) > 0))
      throw UsageError(where + ": " + name + ": a positive value is needed to simulate a flight");
  return vehicle;
}

}  // namespace

struct Plant::Model {
  Vehicle vehicle;
  std::vector<double> p;
  DisturbedEffects effects;
  FlightInputs inputs;
  std::optional<Flight<double, DisturbedEffects>> flight;
  double t = 0.0, command_delay = 0.0;
  mutable FlightState<double> x;

  explicit Model(const Vehicle& given)
      : vehicle(checked(given)),
        p(parameter_vector(vehicle)),
        effects{EffectSet<double>(p, active_effects(p))} {
    inputs.delta.resize(vehicle.rotors.size());
    flight.emplace(vehicle, p, effects, inputs);
    TimeSeam<double> delays{p[param::dead_time], 0.0};
    effects.apply(delays);
    command_delay = delays.command_delay;
  }
};

Plant::Plant(const Vehicle& vehicle) : model_(std::make_unique<Model>(vehicle)) {}
Plant::~Plant() = default;

const Vehicle& Plant::vehicle() const { return model_->vehicle; }
double Plant::constant(param::Index index) const { return model_->p[static_cast<std::size_t>(index)]; }
double Plant::command_delay() const { return model_->command_delay; }
double Plant::sensor_delay() const { return model_->flight->sensor_delay(); }
double Plant::mass() const { return model_->flight->body().mass(); }
Vec3<double> Plant::centre_of_gravity() const { return model_->flight->body().centre_of_gravity(); }

BodyRate<double> Plant::steady_rate(const BodyState<double>& state, std::span<const double> Omega) const {
  std::vector<MotorState<double>> motors;
  for (const double speed : Omega) motors.push_back({speed, 0.0});
  return model_->flight->body().rate(state, motors);
}

void Plant::start(double t, const BodyState<double>& state, std::span<const double> Omega,
                  std::span<const double> delta) {
  model_->t = t;
  model_->x.body = state;
  for (std::size_t n = 0; n < model_->vehicle.rotors.size(); ++n) {
    model_->x.motors[n] = {Omega[n], 0.0};
    model_->inputs.delta[n] = HeldCommand({t}, {delta[n]});
  }
  model_->inputs.t.clear();
  model_->inputs.voltage_ratio.clear();
}

void Plant::command(double t, std::span<const double> delta) {
  for (std::size_t n = 0; n < delta.size(); ++n) model_->inputs.delta[n].append(t, delta[n]);
}

void Plant::recall(const std::vector<double>& t, const std::vector<std::vector<double>>& delta) {
  for (std::size_t n = 0; n < delta.size(); ++n) model_->inputs.delta[n] = HeldCommand(t, delta[n]);
}

void Plant::voltage(double t, double ratio) {
  model_->inputs.t.push_back(t);
  model_->inputs.voltage_ratio.push_back(ratio);
}

void Plant::disturb(const Vec3<double>& F_B, const Vec3<double>& M_B) {
  model_->effects.F_B = F_B;
  model_->effects.M_B = M_B;
}

void Plant::advance(double t, double longest_step) {
  const double start = model_->t;
  if (t <= start) return;
  const int steps = static_cast<int>(std::ceil((t - start) / longest_step * (1.0 - 1e-12)));
  const double h = (t - start) / steps;
  for (int i = 0; i < steps; ++i) {
    const double now = start + i * h;
    model_->x = model_->flight->step(model_->x, now, h, model_->flight->rate(model_->x, now));
    model_->x.body.q_WB.normalize();
  }
  model_->t = t;
}

double Plant::t() const { return model_->t; }
const FlightState<double>& Plant::state() const { return model_->x; }
BodyRate<double> Plant::rate() const { return model_->flight->rate(model_->x, model_->t); }
SensorSeam<double> Plant::imu() const { return model_->flight->imu(model_->x.body.w_B, rate()); }

}  // namespace ident
