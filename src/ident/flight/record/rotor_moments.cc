// Simulates the motors of an arc, and takes the moments per squared speed and per acceleration from the
// model.
#include "ident/flight/record/rotor_moments.h"

#include <array>

#include "ident/flight/record/motor_start.h"
#include "ident/model/flight.h"

namespace ident {

std::vector<std::vector<double>> simulated_speeds(const FlightArc& arc, const Vehicle& vehicle,
                                                  std::span<const double> p) {
  const std::size_t rotors = vehicle.rotors.size();
  std::vector<std::vector<double>> out(rotors, std::vector<double>(arc.rows(), 0.0));
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, *arc.inputs);
  std::array<MotorState<double>, kMaxRotors> motors = motors_at_start(flight, arc.t[0], rotors);
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    for (std::size_t n = 0; n < rotors; ++n) out[n][i] = motors[n].Omega;
    if (i + 1 < arc.rows()) flight.advance(motors, arc.t[i], arc.t[i + 1] - arc.t[i]);
  }
  return out;
}

std::vector<RotorMoment> rotor_moments(const Vehicle& vehicle, std::span<const double> p) {
  const double sigma = vehicle.signs == Signs::first_principles ? 1.0 : -1.0;
  std::vector<RotorMoment> out;
  for (const Rotor& rotor : vehicle.rotors) {
    const Eigen::Vector3d a = axis_at(rotor, p[param::alpha]), per_Jp = -sigma * rotor.s * a;
    out.push_back({p[param::kT] * cross<double, double>(rotor.r_B, a) - rotor.s * p[param::kQ] * a,
                   p[param::Jp] * per_Jp, per_Jp});
  }
  return out;
}

}  // namespace ident
